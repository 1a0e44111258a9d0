#pragma once
// EXT_meshopt_compression: buffer views that are stored compressed.
#include <nlohmann/json_fwd.hpp>

#include "licht/scene/gltf_asset.h"

namespace licht::gltf {

/// True for a buffer that has no bytes of its own because only compressed views refer to it.
bool isMeshoptFallback(const nlohmann::json& buffer);

/// Decodes every compressed buffer view into a buffer of its own, appended to asset.buffers, and lets the
/// view point there: whoever reads views afterwards need not know. Throws InputError naming the view.
void decodeMeshopt(nlohmann::json& document, Asset& asset);

}  // namespace licht::gltf
