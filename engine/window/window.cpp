// The only file that knows GLFW.
#include "licht/window/window.h"

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "licht/core/error.h"

namespace licht {
namespace {

static_assert(kKeySpace == GLFW_KEY_SPACE && kKeyEscape == GLFW_KEY_ESCAPE && kKeyEnter == GLFW_KEY_ENTER &&
              kKeyRight == GLFW_KEY_RIGHT && kKeyLeft == GLFW_KEY_LEFT && kKeyDown == GLFW_KEY_DOWN &&
              kKeyUp == GLFW_KEY_UP);

// GLFW_PLATFORM and GLFW_PLATFORM_X11 of GLFW 3.4; older ones know one platform and no such hint.
constexpr int kPlatformHint = 0x00050003;
constexpr int kPlatformX11 = 0x00060004;

bool isAbsolute(const char* path) {
    return path != nullptr && *path == '/';
}

/// False where libwayland would not look for a display but say so on stderr, even before X11 is asked.
bool canAskWayland() {
    return std::getenv("WAYLAND_SOCKET") != nullptr || isAbsolute(std::getenv("WAYLAND_DISPLAY")) ||
           isAbsolute(std::getenv("XDG_RUNTIME_DIR"));
}

/// GLFW has one state per process, so it lives from its first use to the end of the program.
class Glfw {
public:
    static const Glfw& get() {
        static const Glfw glfw;
        return glfw;
    }
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
    [[nodiscard]] bool running() const { return running_; }

private:
    Glfw() {
        if (!canAskWayland()) {
            glfwInitHint(kPlatformHint, kPlatformX11);
        }
        running_ = glfwInit() == GLFW_TRUE;
    }
    ~Glfw() {
        if (running_) {
            glfwTerminate();
        }
    }
    bool running_ = false;
};

std::string reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

int asInt(std::uint32_t size) {
    return static_cast<int>(std::max(size, 1U));
}

}  // namespace

bool InputState::pressed(int key) const {
    return std::find(keys_pressed.begin(), keys_pressed.end(), key) != keys_pressed.end();
}

bool Window::available() {
    return Glfw::get().running() && glfwVulkanSupported() == GLFW_TRUE;
}

Window::Window(uvec2 size, const std::string& title) {
    if (!Glfw::get().running()) {
        throw DeviceError(fmt::format("no display to open a window on: {}", reason()));
    }
    if (glfwVulkanSupported() != GLFW_TRUE) {
        throw DeviceError(fmt::format("Vulkan cannot present to this display: {}", reason()));
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    handle_ = glfwCreateWindow(asInt(size.x), asInt(size.y), title.c_str(), nullptr, nullptr);
    if (handle_ == nullptr) {
        throw DeviceError(fmt::format("opening a window: {}", reason()));
    }
    glfwSetWindowUserPointer(handle_, this);
    glfwSetKeyCallback(handle_, &Window::onKey);
    glfwSetCursorPosCallback(handle_, &Window::onCursor);
    glfwSetScrollCallback(handle_, &Window::onScroll);
}

Window::~Window() {
    glfwDestroyWindow(handle_);
}

void Window::prepare(gpu::DeviceOptions& options) const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) {
        throw DeviceError(fmt::format("Vulkan cannot present to this display: {}", reason()));
    }
    options.instance_extensions.assign(names, names + count);
    options.create_surface = [handle = handle_](VkInstance instance) {
        VkSurfaceKHR surface = VK_NULL_HANDLE;
        gpu::check(glfwCreateWindowSurface(instance, handle, nullptr, &surface),
                   "creating the window's surface");
        return surface;
    };
}

InputState Window::poll() {
    glfwPollEvents();
    return take();
}

InputState Window::waitAndPoll(double seconds) {
    glfwWaitEventsTimeout(seconds);
    return take();
}

InputState Window::take() {
    return std::exchange(input_, {});
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(handle_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(handle_, GLFW_TRUE);
}

uvec2 Window::framebufferSize() const {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(handle_, &width, &height);
    return {static_cast<std::uint32_t>(std::max(width, 0)), static_cast<std::uint32_t>(std::max(height, 0))};
}

void Window::resize(uvec2 size) {
    glfwSetWindowSize(handle_, asInt(size.x), asInt(size.y));
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(handle_, title.c_str());
}

double Window::seconds() const {
    return glfwGetTime();
}

void Window::onKey(GLFWwindow* handle, int key, int /*scancode*/, int action, int /*modifiers*/) {
    if (action == GLFW_PRESS) {
        static_cast<Window*>(glfwGetWindowUserPointer(handle))->input_.keys_pressed.push_back(key);
    }
}

void Window::onCursor(GLFWwindow* handle, double x, double y) {
    auto& window = *static_cast<Window*>(glfwGetWindowUserPointer(handle));
    const vec2 cursor(static_cast<float>(x), static_cast<float>(y));
    // The first position has nothing to be compared with.
    const vec2 moved = window.cursor_known_ ? cursor - window.cursor_ : vec2(0.0F);
    window.cursor_ = cursor;
    window.cursor_known_ = true;
    const auto down = [&](int button) { return glfwGetMouseButton(handle, button) == GLFW_PRESS; };
    const bool shift = glfwGetKey(handle, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
                       glfwGetKey(handle, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
    const bool left = down(GLFW_MOUSE_BUTTON_LEFT);
    if (down(GLFW_MOUSE_BUTTON_RIGHT) || down(GLFW_MOUSE_BUTTON_MIDDLE) || (left && shift)) {
        window.input_.pan += moved;
    } else if (left) {
        window.input_.orbit += moved;
    }
}

void Window::onScroll(GLFWwindow* handle, double /*x*/, double y) {
    static_cast<Window*>(glfwGetWindowUserPointer(handle))->input_.dolly += static_cast<float>(y);
}

}  // namespace licht
