#pragma once
#include <nlohmann/json_fwd.hpp>

#include "licht/scene/gltf_asset.h"

namespace licht::gltf {

/// Throws InputError where a number that stands for an index is no whole one of 32 bits. The parser behind
/// cuts such to another index or takes them for missing.
void requireIndices(const nlohmann::json& document, const Asset& asset);

}  // namespace licht::gltf
