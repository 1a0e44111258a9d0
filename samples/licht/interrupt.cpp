#include "samples/licht/interrupt.h"

#include <array>
#include <cassert>
#include <csignal>

namespace licht {
namespace {

constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t signalled = 0;
std::array<struct sigaction, kSignals.size()> previous{};
bool watching = false;

extern "C" void noteSignal(int /*signal*/) {
    signalled = 1;
}

}  // namespace

InterruptWatch::InterruptWatch() {
    assert(!watching);
    watching = true;
    signalled = 0;
    struct sigaction action {};
    action.sa_handler = noteSignal;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        sigaction(kSignals[i], &action, &previous[i]);
        // nohup: who started the program wants it to outlive the terminal.
        if (kSignals[i] == SIGHUP && previous[i].sa_handler == SIG_IGN)
            sigaction(kSignals[i], &previous[i], nullptr);
    }
}

InterruptWatch::~InterruptWatch() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &previous[i], nullptr);
    watching = false;
}

bool InterruptWatch::asked() const {
    return signalled != 0;
}

void InterruptWatch::shield() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigemptyset(&ignore.sa_mask);
    for (const int signal : kSignals) sigaction(signal, &ignore, nullptr);
}

}  // namespace licht
