#include "licht/core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cassert>
#include <cerrno>
#include <system_error>

#include "licht/core/error.h"

namespace licht {
namespace {

std::string reason(int error_number) {
    return std::generic_category().message(error_number);
}

/// An open file descriptor that closes itself.
class Descriptor {
public:
    Descriptor(const std::filesystem::path& path, int flags, mode_t mode = 0)
        : number_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    [[nodiscard]] bool valid() const { return number_ >= 0; }
    [[nodiscard]] int number() const { return number_; }
    /// False with errno set when the file system reports a late error.
    bool close() {
        const int number = number_;
        number_ = -1;
        return ::close(number) == 0;
    }

private:
    int number_;
};

/// Repeats a call that a signal interrupted.
template <typename Call>
ssize_t uninterrupted(Call call) {
    ssize_t result = -1;
    do {
        result = call();
    } while (result < 0 && errno == EINTR);
    return result;
}

/// Refuses destinations that a rename would destroy or cannot replace: folders and devices.
void requireReplaceable(const std::filesystem::path& destination) {
    if (destination.empty()) throw InputError("cannot write: the file name is empty");
    if (!destination.has_filename())
        throw InputError(fmt::format("{}: cannot write, it is a folder", destination.string()));
    struct stat status {};
    if (::stat(destination.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode))
            throw InputError(fmt::format("{}: cannot write, it is a folder", destination.string()));
        if (!S_ISREG(status.st_mode))
            throw InputError(fmt::format("{}: cannot write, it is no regular file", destination.string()));
    } else if (errno != ENOENT) {
        throw InputError(fmt::format("{}: cannot write: {}", destination.string(), reason(errno)));
    }
}

/// Creates a file of a new name beside `destination`.
std::filesystem::path createBeside(const std::filesystem::path& destination) {
    static std::atomic<unsigned> count = 0;
    const std::filesystem::path folder =
        destination.has_parent_path() ? destination.parent_path() : std::filesystem::path(".");
    for (;;) {
        const std::string name =
            fmt::format(".licht-{}-{}.tmp{}", ::getpid(), count++, destination.extension().string());
        std::filesystem::path path = folder / name;
        const Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (file.valid()) return path;
        // EEXIST: left behind by a crashed process that had the same number.
        if (errno == EEXIST) continue;
        const std::string why = errno == ENOENT ? "its folder does not exist" : reason(errno);
        throw InputError(fmt::format("{}: cannot write: {}", destination.string(), why));
    }
}

}  // namespace

std::uint64_t requireRegularFile(const std::filesystem::path& path) {
    if (path.empty()) throw InputError("cannot read: the file name is empty");
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        const std::string why = errno == ENOENT ? "no such file" : "cannot read: " + reason(errno);
        throw InputError(fmt::format("{}: {}", path.string(), why));
    }
    if (S_ISDIR(status.st_mode)) throw InputError(fmt::format("{}: is a folder, not a file", path.string()));
    if (!S_ISREG(status.st_mode)) throw InputError(fmt::format("{}: is no regular file", path.string()));
    return static_cast<std::uint64_t>(status.st_size);
}

std::vector<std::byte> readFile(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const std::uint64_t size = requireRegularFile(path);
    if (size > max_bytes)
        throw InputError(
            fmt::format("{}: has {} bytes, more than the {} allowed", path.string(), size, max_bytes));
    const Descriptor file(path, O_RDONLY);
    if (!file.valid()) throw InputError(fmt::format("{}: cannot read: {}", path.string(), reason(errno)));
    std::vector<std::byte> bytes(size);
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got =
            uninterrupted([&] { return ::read(file.number(), bytes.data() + done, bytes.size() - done); });
        if (got < 0) throw InputError(fmt::format("{}: cannot read: {}", path.string(), reason(errno)));
        if (got == 0) throw InputError(fmt::format("{}: became shorter while it was read", path.string()));
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    struct stat status_a {};
    struct stat status_b {};
    const bool there_a = ::stat(a.c_str(), &status_a) == 0;
    const bool there_b = ::stat(b.c_str(), &status_b) == 0;
    if (there_a != there_b) return false;
    if (there_a) return status_a.st_dev == status_b.st_dev && status_a.st_ino == status_b.st_ino;
    std::error_code error_a;
    std::error_code error_b;
    const std::filesystem::path path_a =
        std::filesystem::weakly_canonical(std::filesystem::absolute(a, error_a), error_a);
    const std::filesystem::path path_b =
        std::filesystem::weakly_canonical(std::filesystem::absolute(b, error_b), error_b);
    return !error_a && !error_b && path_a == path_b;
}

AtomicFile::AtomicFile(std::filesystem::path destination) : destination_(std::move(destination)) {
    requireReplaceable(destination_);
    // A link stays a link: what it points to is replaced.
    std::error_code error;
    if (std::filesystem::path target = std::filesystem::canonical(destination_, error); !error)
        destination_ = std::move(target);
    temporary_ = createBeside(destination_);
}

AtomicFile::~AtomicFile() {
    if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
    assert(!committed_);
    Descriptor file(temporary_, O_RDONLY);
    if (!file.valid() || ::fsync(file.number()) != 0 || !file.close())
        throw DeviceError(fmt::format("{}: writing failed: {}", destination_.string(), reason(errno)));
    // Who may read and write a file that is replaced stays as it was. Last, because it may be nobody.
    struct stat status {};
    if (::stat(destination_.c_str(), &status) == 0) ::chmod(temporary_.c_str(), status.st_mode & 07777U);
    if (::rename(temporary_.c_str(), destination_.c_str()) != 0)
        throw DeviceError(fmt::format("{}: writing failed: {}", destination_.string(), reason(errno)));
    committed_ = true;
    // The new name itself reaches the disk with the folder; a file system that cannot do this loses no
    // content by it.
    const Descriptor folder(temporary_.parent_path(), O_RDONLY | O_DIRECTORY);
    if (folder.valid()) ::fsync(folder.number());
}

void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    AtomicFile file(path);
    Descriptor out(file.temporary(), O_WRONLY);
    bool good = out.valid();
    while (good && !bytes.empty()) {
        const ssize_t put = uninterrupted([&] { return ::write(out.number(), bytes.data(), bytes.size()); });
        good = put >= 0;
        if (good) bytes = bytes.subspan(static_cast<std::size_t>(put));
    }
    if (!good || !out.close())
        throw DeviceError(fmt::format("{}: writing failed: {}", path.string(), reason(errno)));
    file.commit();
}

}  // namespace licht
