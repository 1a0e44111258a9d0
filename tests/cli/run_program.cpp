#include "run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace licht::test {
namespace {

/// The mask of caught signals in proc(5)'s status file.
unsigned long long caughtSignals(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/status");
    for (std::string word; file >> word;)
        if (word == "SigCgt:") {
            file >> word;
            return std::stoull(word, nullptr, 16);
        }
    return 0;
}

[[noreturn]] void become(const ScratchFolder& folder, const ScratchFolder& said,
                         const std::vector<std::string>& arguments, const Environment& environment) {
    const auto redirect = [&](const char* name, int descriptor) {
        const int file = open(said.file(name).c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
        return file >= 0 && dup2(file, descriptor) >= 0;
    };
    if (!redirect("out", STDOUT_FILENO) || !redirect("err", STDERR_FILENO) ||
        chdir(folder.path().c_str()) != 0)
        _exit(126);
    setenv("LICHT_VALIDATION", "1", 1);
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    std::vector<std::string> words{LICHT_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(LICHT_PROGRAM, pointers.data());
    _exit(127);
}

}  // namespace

ScratchFolder::ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "licht_test_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
    path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> ScratchFolder::contents() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
        names.push_back(std::filesystem::relative(entry.path(), path_).string());
    std::sort(names.begin(), names.end());
    return names;
}

void ScratchFolder::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
}

std::string ScratchFolder::read(const std::string& name) const {
    std::ostringstream bytes;
    bytes << std::ifstream(path_ / name, std::ios::binary).rdbuf();
    return bytes.str();
}

std::vector<std::string> Outcome::errorLines() const {
    std::vector<std::string> lines;
    std::istringstream stream(err);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

RunningProgram::RunningProgram(const ScratchFolder& folder, const std::vector<std::string>& arguments,
                               const Environment& environment) {
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    if (pid_ == 0) become(folder, said_, arguments, environment);
}

RunningProgram::~RunningProgram() {
    if (pid_ < 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

bool RunningProgram::waitUntilCatches(int signal) const {
    const unsigned long long bit = 1ULL << static_cast<unsigned>(signal - 1);
    while ((caughtSignals(pid_) & bit) == 0) {
        siginfo_t ended{};
        if (waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
            ended.si_pid != 0)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

void RunningProgram::send(int signal) const {
    kill(pid_, signal);
}

Outcome RunningProgram::wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said_.read("out"), said_.read("err")};
}

}  // namespace licht::test
