#pragma once
// Runs the built `licht` as its users do, and keeps what it said and left behind.
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace licht::test {

/// A folder of its own that goes away with the value.
class ScratchFolder {
public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
    /// Everything in it and below, relative and sorted.
    [[nodiscard]] std::vector<std::string> contents() const;
    void write(const std::string& name, const std::string& bytes) const;
    [[nodiscard]] std::string read(const std::string& name) const;

private:
    std::filesystem::path path_;
};

struct Outcome {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out;
    std::string err;

    [[nodiscard]] std::vector<std::string> errorLines() const;
};

using Environment = std::vector<std::pair<std::string, std::string>>;

/// A `licht` that is running; the working folder is `folder`. The validation layer is on.
class RunningProgram {
public:
    RunningProgram(const ScratchFolder& folder, const std::vector<std::string>& arguments,
                   const Environment& environment = {});
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;
    ~RunningProgram();

    /// True once the process catches this signal; false when it ends before.
    bool waitUntilCatches(int signal) const;
    void send(int signal) const;
    Outcome wait();

private:
    ScratchFolder said_;
    pid_t pid_ = -1;
};

inline Outcome runLicht(const ScratchFolder& folder, const std::vector<std::string>& arguments,
                        const Environment& environment = {}) {
    return RunningProgram(folder, arguments, environment).wait();
}

}  // namespace licht::test
