#include "samples/licht/outputs.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <csignal>
#include <cstdio>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/image/files.h"

namespace licht {
namespace {

bool lost_output = false;

bool put(std::string_view text, std::FILE* stream) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    const bool flushed = std::fflush(stream) == 0;
    return written && flushed;
}

}  // namespace

void secureStandardStreams() {
    for (const int number : {0, 1, 2}) {
        if (::fcntl(number, F_GETFD) != -1) continue;
        // Open takes the lowest number that is free. On a full device, so that losses are seen.
        if (::open("/dev/full", O_RDWR) < 0 && ::open("/dev/null", O_RDWR) < 0) lost_output = true;
    }
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void printOut(std::string_view text) {
    if (!put(text, stdout)) lost_output = true;
}

bool lostOutput() {
    return lost_output;
}

void printError(std::string_view text) {
    put(text, stderr);
}

void checkWritable(const std::filesystem::path& path) {
    const AtomicFile probe(path);
}

void requireOwnFiles(std::span<const std::filesystem::path> outputs,
                     std::span<const std::filesystem::path> inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const auto& input : inputs)
            if (sameFile(outputs[i], input))
                throw InputError(
                    fmt::format("{}: cannot write, it is read as {}", outputs[i].string(), input.string()));
        for (const auto& other : outputs.first(i))
            if (sameFile(outputs[i], other))
                throw InputError(fmt::format("{}: cannot write, {} is written there too", outputs[i].string(),
                                             other.string()));
    }
}

void requireNoStranger(const std::filesystem::path& picture) {
    std::error_code error;
    if (std::filesystem::exists(picture, error) && !isOwnPng(picture))
        throw InputError(
            fmt::format("{}: is there and no picture of Licht's: name the output by -o", picture.string()));
}

}  // namespace licht
