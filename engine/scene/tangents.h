#pragma once
#include "licht/scene/scene.h"

namespace licht {

/// Fills mesh.tangents for the texture coordinates as `slot` reads them (set and transform): per corner,
/// weighted by its angle, summed by vertex, then made orthogonal to the normal (Lengyel 2001, Computing
/// Tangent Space Basis Vectors for an Arbitrary Mesh). As in glTF, normal x tangent * w points against
/// growing v, up in the picture. Where coordinates are missing or degenerate any tangent orthogonal to the
/// normal is taken. Without normals the faces' own, averaged, take their place.
void deriveTangents(Mesh& mesh, const TextureSlot& slot);

}  // namespace licht
