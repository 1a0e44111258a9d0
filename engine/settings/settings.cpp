#include "licht/settings/settings.h"

#include <bit>

namespace licht {

bool offersOidn() {
    return LICHT_HAS_OIDN == 1;
}

std::uint32_t blueBitsFor(std::optional<std::uint32_t> samples) {
    constexpr std::uint32_t kMostBits = 10;
    if (!samples) return RenderSettings{}.blue_bits;
    return std::min(static_cast<std::uint32_t>(std::bit_width(*samples - 1)), kMostBits);
}

}  // namespace licht
