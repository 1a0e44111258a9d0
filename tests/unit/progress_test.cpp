#include "licht/core/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>
#include <thread>

namespace licht {
namespace {

/// A pseudo-terminal: what is printed to stream() comes out of written().
class Terminal {
public:
    Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
        if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0)
            throw std::runtime_error("no pseudo-terminal");
        stream_ = std::fopen(::ptsname(master_), "w");
        if (stream_ == nullptr) throw std::runtime_error("cannot open the pseudo-terminal");
        ::fcntl(master_, F_SETFL, O_NONBLOCK);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
    ~Terminal() {
        std::fclose(stream_);
        ::close(master_);
    }
    [[nodiscard]] std::FILE* stream() const { return stream_; }
    [[nodiscard]] std::string written() const {
        std::string text;
        std::array<char, 1024> part{};
        for (ssize_t got = 0; (got = ::read(master_, part.data(), part.size())) > 0;)
            text.append(part.data(), static_cast<std::size_t>(got));
        return text;
    }

private:
    int master_;
    std::FILE* stream_ = nullptr;
};

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(ProgressText, SaysWhatIsKnown) {
    EXPECT_EQ(progressText({16, 64, 3.2, 0.12, 9.6}), "16/64 samples  3.2 s  error 0.12  9.6 s left");
    EXPECT_EQ(progressText({16, 0, 3.2, -1.0, -1.0}), "16 samples  3.2 s");
    EXPECT_EQ(progressText({0, 1, 0.0, -1.0, -1.0}), "0/1 samples  0.0 s");
}

TEST(ProgressLine, RewritesItselfOnATerminalAndClearsAtTheEnd) {
    const Terminal terminal;
    {
        ProgressLine line(terminal.stream(), false);
        line.show(ProgressState{1, 4, 0.1, -1.0, -1.0});
    }
    const std::string text = terminal.written();
    EXPECT_NE(text.find("1/4 samples"), std::string::npos) << text;
    const std::string clear = "\r\x1b[K";
    EXPECT_EQ(text.substr(text.size() - clear.size()), clear);
    EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(ProgressLine, IsDrawnAtMostTenTimesASecond) {
    const Terminal terminal;
    const auto start = std::chrono::steady_clock::now();
    {
        ProgressLine line(terminal.stream(), false);
        for (std::uint64_t i = 0; i < 30; ++i) {
            line.show(ProgressState{i, 0, 0.0, -1.0, -1.0});
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const std::size_t drawn = count(terminal.written(), "samples");
    EXPECT_GE(drawn, 2U);
    EXPECT_LE(static_cast<double>(drawn), 1.0 + 10.0 * seconds.count());
}

TEST(ProgressLine, AnnouncesAtOnceAndShowsBehindIt) {
    const Terminal terminal;
    {
        ProgressLine line(terminal.stream(), false);
        line.announce("compiling 'a'");
        line.announce("compiling 'b'");
        line.show(ProgressState{1, 4, 0.1, -1.0, -1.0});
    }
    const std::string text = terminal.written();
    const std::size_t first = text.find("compiling 'a'");
    const std::size_t second = text.find("compiling 'b'");
    EXPECT_LT(first, second) << text;
    EXPECT_NE(second, std::string::npos) << text;
    EXPECT_NE(text.find("1/4 samples", second), std::string::npos) << text;
}

TEST(ProgressLine, IsSilentWhenQuietOrNoTerminal) {
    const Terminal terminal;
    { ProgressLine(terminal.stream(), true).show(ProgressState{1, 4, 0.1, -1.0, -1.0}); }
    EXPECT_EQ(terminal.written(), "");

    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    { ProgressLine(file, false).show(ProgressState{1, 4, 0.1, -1.0, -1.0}); }
    EXPECT_EQ(std::ftell(file), 0);
    std::fclose(file);
}

}  // namespace
}  // namespace licht
