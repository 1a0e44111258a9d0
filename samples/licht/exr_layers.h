#pragma once
#include <string>
#include <utility>
#include <vector>

#include "licht/film/film.h"
#include "licht/image/exr.h"
#include "licht/settings/layers.h"

namespace licht {

/// The film as EXR channels under the ecosystem's names: R G B A, and the layers asked for.
ExrPicture exrPicture(const Film& film, const LayerSet& layers,
                      std::vector<std::pair<std::string, std::string>> attributes);

}  // namespace licht
