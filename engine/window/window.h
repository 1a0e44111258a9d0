#pragma once
#include <string>
#include <vector>

#include "licht/core/math.h"
#include "licht/gpu/device.h"

struct GLFWwindow;

namespace licht {

/// What the user did since the last poll. Distances in the window's own units, y down.
struct InputState {
    vec2 orbit{0.0F};               ///< drag with the left button
    vec2 pan{0.0F};                 ///< drag with the right or middle button, or with the left one and shift
    float dolly = 0.0F;             ///< notches of the wheel; positive: away from the user
    std::vector<int> keys_pressed;  ///< what Key and the letters' upper-case ASCII codes name

    [[nodiscard]] bool pressed(int key) const;
};

/// Keys without a letter, as InputState names them.
enum Key : int {
    kKeySpace = 32,
    kKeyEscape = 256,
    kKeyEnter = 257,
    kKeyRight = 262,
    kKeyLeft = 263,
    kKeyDown = 264,
    kKeyUp = 265
};

/// A window that a Device can present to. Windows live on one thread and outlive the Device that draws into
/// them.
class Window {
public:
    /// Throws DeviceError with GLFW's reason when there is no display or no Vulkan presentation on it.
    Window(uvec2 size, const std::string& title);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    /// True when a display exists that Vulkan can present to. Prints nothing and never throws.
    static bool available();

    /// Adds to `options` what a Device needs to present here.
    void prepare(gpu::DeviceOptions& options) const;

    /// Handles waiting events and returns what was done since the last call.
    InputState poll();
    /// The same, after sleeping until something happens or the time is over.
    InputState waitAndPoll(double seconds);
    [[nodiscard]] bool shouldClose() const;
    void close();
    /// Pixels; zero while the window is minimised.
    [[nodiscard]] uvec2 framebufferSize() const;
    /// Asks for a new size of the content, in the window's own units.
    void resize(uvec2 size);
    void setTitle(const std::string& title);
    /// Seconds since the first window of the program was made.
    [[nodiscard]] double seconds() const;

private:
    static void onKey(GLFWwindow* handle, int key, int scancode, int action, int modifiers);
    static void onCursor(GLFWwindow* handle, double x, double y);
    static void onScroll(GLFWwindow* handle, double x, double y);
    InputState take();

    GLFWwindow* handle_ = nullptr;
    InputState input_;
    vec2 cursor_{0.0F};
    bool cursor_known_ = false;
};

}  // namespace licht
