#include "licht/oidn/oidn.h"

#include <OpenImageDenoise/oidn.h>

#include <cassert>
#include <string>
#include <type_traits>

#include "licht/core/error.h"
#include "licht/film/error_estimate.h"

namespace licht {
namespace {

template <auto release>
struct Release {
    template <typename Handle>
    void operator()(Handle handle) const {
        release(handle);
    }
};
template <typename Handle, auto release>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<release>>;

class Network : public Oidn {
public:
    // The picture is in the host's memory, which other devices of the library may not read.
    Network() : device_(oidnNewDevice(OIDN_DEVICE_TYPE_CPU)) {
        if (device_) oidnCommitDevice(device_.get());
        check();
    }

    void filter(Film& film) override {
        assert(!film.layer(LayerId::albedo).texels.empty() && !film.layer(LayerId::normal).texels.empty());
        film.unfiltered_error = relativeError(film);
        film.unfiltered = film.mean;
        film.variance = {};
        const Owned<OIDNFilter, oidnReleaseFilter> filter(oidnNewFilter(device_.get(), "RT"));
        setImage(filter.get(), "color", film.unfiltered);
        setImage(filter.get(), "albedo", film.layer(LayerId::albedo));
        setImage(filter.get(), "normal", film.layer(LayerId::normal));
        setImage(filter.get(), "output", film.mean);
        oidnSetFilterBool(filter.get(), "hdr", true);
        oidnCommitFilter(filter.get());
        oidnExecuteFilter(filter.get());
        check();
    }

private:
    /// Its first three channels.
    static void setImage(OIDNFilter filter, const char* name, Image& image) {
        oidnSetSharedFilterImage(filter, name, image.texels.data(), OIDN_FORMAT_FLOAT3,
                                 static_cast<std::size_t>(image.width),
                                 static_cast<std::size_t>(image.height), 0,
                                 sizeof(float) * static_cast<std::size_t>(image.channels), 0);
    }
    void check() const {
        const char* message = nullptr;
        if (oidnGetDeviceError(device_.get(), &message) != OIDN_ERROR_NONE)
            throw DeviceError(std::string("OpenImageDenoise: ") + (message != nullptr ? message : "failed"));
    }

    Owned<OIDNDevice, oidnReleaseDevice> device_;
};

}  // namespace

std::unique_ptr<Oidn> makeOidn() {
    return std::make_unique<Network>();
}

}  // namespace licht
