// fuzz_NAME [COUNT [SEED]]: reads the seeds and COUNT damaged ones. An input that ends the program stays in
//     fuzz_NAME.input.
// fuzz_NAME FILE...: reads these.
#include <sys/time.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "fuzz.h"
#include "licht/core/file.h"
#include "mutation.h"

namespace {

constexpr long kMostSeconds =
    20;  // of one input, while it computes: the machine may be busy with something else

std::string g_input;
const char* g_kept_in = nullptr;

/// Whatever ends the program: the input is kept.
void keepInput(int signal_number) {
    std::FILE* file = std::fopen(g_kept_in, "wb");
    if (file != nullptr) {
        std::fwrite(g_input.data(), 1, g_input.size(), file);
        std::fclose(file);
    }
    std::fprintf(stderr, "signal %d: the input is in %s\n", signal_number, g_kept_in);
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

void limitTime(long seconds) {
    const itimerval once{{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &once, nullptr);
}

/// Whether it was taken.
bool read(std::string input) {
    g_input = std::move(input);
    limitTime(kMostSeconds);
    bool taken = false;
    try {
        taken = licht::fuzz::readInput(g_input);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "not refused but: %s\n", error.what());
        std::abort();
    }
    limitTime(0);
    return taken;
}

}  // namespace

int main(int argument_count, char** arguments) {
    const std::string kept_in = std::string(arguments[0]) + ".input";
    g_kept_in = kept_in.c_str();
    for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGPROF})
        std::signal(number, keepInput);
    char* end = nullptr;
    const unsigned long count = argument_count > 1 ? std::strtoul(arguments[1], &end, 10) : 1000;
    if (end != nullptr && *end != '\0') {
        for (int i = 1; i < argument_count; ++i) {
            const std::vector<std::byte> bytes = licht::readFile(arguments[i]);
            read(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        }
        return 0;
    }
    const std::vector<std::string> seeds = licht::fuzz::seeds();
    for (const std::string& seed : seeds)
        if (!read(seed)) {
            std::fprintf(stderr, "a good input was refused\n");
            return 1;
        }
    std::mt19937_64 random(argument_count > 2 ? std::strtoul(arguments[2], nullptr, 10) : 1);
    unsigned long taken = 0;
    for (unsigned long i = 0; i < count; ++i) taken += read(licht::fuzz::damaged(seeds, random)) ? 1U : 0U;
    std::printf("%zu good inputs and %lu damaged ones, of which %lu were taken\n", seeds.size(), count,
                taken);
    return 0;
}
