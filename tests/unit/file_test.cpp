#include "licht/core/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <string>

#include "licht/core/error.h"

namespace licht {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "licht-file-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    static void put(const fs::path& path, const std::string& text) {
        std::ofstream(path, std::ios::binary) << text;
    }
    static std::string get(const fs::path& path) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }
    [[nodiscard]] std::ptrdiff_t entries() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }

    fs::path folder_;
};

/// Runs `call`, which must throw InputError, and checks that its text is one line that names both.
template <typename Call>
void expectInputError(Call call, const std::string& name, const std::string& reason) {
    try {
        call();
        ADD_FAILURE() << "no InputError for " << name;
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find(name), std::string::npos) << text;
        EXPECT_NE(text.find(reason), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

TEST_F(FileTest, ReadsEveryByte) {
    std::string text(100000, '\0');
    for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * 7);
    put(folder_ / "a", text);
    const auto bytes = readFile(folder_ / "a");
    ASSERT_EQ(bytes.size(), text.size());
    EXPECT_EQ(std::memcmp(bytes.data(), text.data(), text.size()), 0);
    put(folder_ / "empty", "");
    EXPECT_TRUE(readFile(folder_ / "empty").empty());
}

TEST_F(FileTest, ReadRefusesWhatIsNoFile) {
    const fs::path fifo = folder_ / "fifo";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    expectInputError([&] { readFile(folder_ / "missing"); }, "missing", "no such file");
    expectInputError([&] { readFile(folder_); }, folder_.string(), "folder");
    expectInputError([&] { readFile(fifo); }, "fifo", "no regular file");
    expectInputError([&] { readFile("/dev/zero"); }, "/dev/zero", "no regular file");
    expectInputError([&] { readFile(""); }, "", "empty");
    expectInputError([&] { readFile(folder_ / std::string(300, 'n')); }, "nnn", "cannot read");
    put(folder_ / "file", "x");
    expectInputError([&] { readFile(folder_ / "file" / "below"); }, "below", "cannot read");
}

TEST_F(FileTest, ReadRefusesMoreThanAllowed) {
    put(folder_ / "ten", "0123456789");
    EXPECT_EQ(readFile(folder_ / "ten", 10).size(), 10U);
    expectInputError([&] { readFile(folder_ / "ten", 9); }, "ten", "10 bytes");
}

TEST_F(FileTest, CommitReplacesAndLeavesNothingElse) {
    const fs::path path = folder_ / "picture.png";
    put(path, "old");
    {
        AtomicFile file(path);
        EXPECT_EQ(file.temporary().parent_path(), fs::canonical(folder_));
        EXPECT_EQ(file.temporary().extension(), ".png");
        put(file.temporary(), "new");
        EXPECT_EQ(get(path), "old");
        file.commit();
    }
    EXPECT_EQ(get(path), "new");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, CommitKeepsWhoMayReadAndWrite) {
    const fs::path path = folder_ / "mode.txt";
    put(path, "old");
    for (const mode_t mode : {0600U, 0664U, 0400U}) {
        ASSERT_EQ(::chmod(path.c_str(), mode), 0);
        writeFile(path, std::as_bytes(std::span("new", 3)));
        struct stat status {};
        ASSERT_EQ(::stat(path.c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 07777U, mode);
    }
}

TEST_F(FileTest, AbandonedFileKeepsTheOldContent) {
    const fs::path path = folder_ / "picture.png";
    put(path, "old");
    {
        const AtomicFile file(path);
        put(file.temporary(), "half");
    }
    EXPECT_EQ(get(path), "old");
    EXPECT_EQ(entries(), 1);
    {
        const AtomicFile file(folder_ / "never.png");
        EXPECT_EQ(entries(), 2);
    }
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, TwoWritersOfOneNameDoNotMeet) {
    const fs::path path = folder_ / "a.exr";
    AtomicFile first(path);
    AtomicFile second(path);
    EXPECT_NE(first.temporary(), second.temporary());
    put(first.temporary(), "first");
    put(second.temporary(), "second");
    second.commit();
    first.commit();
    EXPECT_EQ(get(path), "first");
}

TEST_F(FileTest, WriteRefusesImpossiblePlaces) {
    const auto open = [](const fs::path& path) { return [path] { const AtomicFile file(path); }; };
    expectInputError(open(folder_), folder_.string(), "folder");
    expectInputError(open(folder_ / ""), folder_.string(), "folder");
    expectInputError(open(folder_ / "missing" / "a.png"), "a.png", "its folder does not exist");
    expectInputError(open(""), "", "empty");
    // A rename over a device would replace the device.
    expectInputError(open("/dev/null"), "/dev/null", "no regular file");
    put(folder_ / "file", "x");
    expectInputError(open(folder_ / "file" / "a.png"), "a.png", "cannot write");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, WriteRefusesFolderWithoutPermission) {
    const fs::path closed = folder_ / "closed";
    fs::create_directory(closed);
    fs::permissions(folder_, fs::perms::all);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                fs::perms::others_exec);
    // The superuser may write anywhere, so for him the attempt is made as "nobody".
    const bool superuser = ::geteuid() == 0;
    constexpr uid_t nobody = 65534;
    if (superuser) {
        ASSERT_EQ(::seteuid(nobody), 0);
    }
    expectInputError([&] { const AtomicFile file(closed / "a.png"); }, "a.png",
                     "cannot write: Permission denied");
    if (superuser) {
        ASSERT_EQ(::seteuid(0), 0);
    }
}

TEST_F(FileTest, WriteFollowsALink) {
    put(folder_ / "target.png", "old");
    fs::create_symlink("target.png", folder_ / "link.png");
    const std::string text = "new";
    writeFile(folder_ / "link.png", std::as_bytes(std::span(text)));
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.png"));
    EXPECT_EQ(get(folder_ / "target.png"), "new");
}

TEST_F(FileTest, CommitReportsFailure) {
    AtomicFile file(folder_ / "a.png");
    fs::remove(file.temporary());
    EXPECT_THROW(file.commit(), DeviceError);
    EXPECT_EQ(entries(), 0);
}

TEST_F(FileTest, WriteFileRoundTrip) {
    const std::string text(3000000, 'x');
    writeFile(folder_ / "a", std::as_bytes(std::span(text)));
    EXPECT_EQ(get(folder_ / "a"), text);
    writeFile(folder_ / "a", {});
    EXPECT_EQ(get(folder_ / "a"), "");
}

}  // namespace
}  // namespace licht
