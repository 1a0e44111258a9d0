#pragma once
#include <nlohmann/json_fwd.hpp>

#include "licht/scene/gltf_asset.h"

namespace licht::gltf {

/// Throws InputError where a count, offset, length or stride of an accessor or buffer view is none. The
/// parser behind takes such for missing or cuts it to 32 bits, each version of it others.
void requireSizes(const nlohmann::json& document, const Asset& asset);

}  // namespace licht::gltf
