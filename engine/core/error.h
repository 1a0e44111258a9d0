#pragma once
#include <stdexcept>
#include <string>

namespace licht {

/// Bad input or usage: a file, an object in it, or an option is wrong. The text is one line that names all
/// three. Exit code 2.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The device or the engine failed. Exit code 1.
class DeviceError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The device does not answer. Nothing of it can be freed, and leaving the usual way could wait for it: the
/// program should say so and end at once (std::_Exit).
class HungDeviceError : public DeviceError {
public:
    using DeviceError::DeviceError;
};

}  // namespace licht
