#include "licht/film/film.h"

#include <cassert>

namespace licht {

Film mergeFilms(const Film& a, const Film& b) {
    assert(a.size == b.size);
    if (a.samples == 0) return b;
    if (b.samples == 0) return a;
    Film merged = a;  // the layers of one range stand for both
    merged.samples = a.samples + b.samples;
    const double na = a.samples;
    const double nb = b.samples;
    const double n = na + nb;
    for (std::size_t i = 0; i < std::size_t{a.size.x} * a.size.y; ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            const double ma = static_cast<double>(a.mean.texels[4 * i + c]);
            const double mb = static_cast<double>(b.mean.texels[4 * i + c]);
            merged.mean.texels[4 * i + c] = static_cast<float>(ma + (mb - ma) * (nb / n));
            if (c == 3) continue;
            const double squares = static_cast<double>(a.variance.texels[3 * i + c]) * na * (na - 1.0) +
                                   static_cast<double>(b.variance.texels[3 * i + c]) * nb * (nb - 1.0) +
                                   (mb - ma) * (mb - ma) * na * nb / n;
            merged.variance.texels[3 * i + c] = static_cast<float>(squares / (n * (n - 1.0)));
        }
    }
    return merged;
}

}  // namespace licht
