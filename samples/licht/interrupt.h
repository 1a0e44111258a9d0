#pragma once

namespace licht {

/// While it lives, the first Ctrl-C (SIGINT), SIGTERM or SIGHUP (the terminal is gone; unless it is ignored,
/// as by nohup) asks to finish, and a second one ends the process at once. One at a time.
class InterruptWatch {
public:
    InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;
    ~InterruptWatch();

    [[nodiscard]] bool asked() const;
    /// From here on such signals are ignored, so that files are written whole.
    void shield();
};

}  // namespace licht
