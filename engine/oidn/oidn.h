#pragma once
// Intel's Open Image Denoise: a network that was trained on noisy and clean pictures filters one on the host.
#include <memory>

#include "licht/film/film.h"

namespace licht {

class Oidn {
public:
    Oidn() = default;
    Oidn(const Oidn&) = delete;
    Oidn& operator=(const Oidn&) = delete;
    virtual ~Oidn() = default;

    /// Of a film that has the layers albedo and normal: RGB of its mean becomes what the network makes of it
    /// by those two, and the mean is `unfiltered`. Nothing is known of the new picture's error, so `variance`
    /// is empty from then on. Throws DeviceError.
    virtual void filter(Film& film) = 0;
};

/// Null where the program was made without the library (offersOidn()). Throws DeviceError.
std::unique_ptr<Oidn> makeOidn();

}  // namespace licht
