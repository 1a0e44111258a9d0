#pragma once
#include "licht/scene/scene.h"

namespace licht {

/// Fills mesh.tangents for the texture coordinates as `slot` reads them (set and transform): per corner,
/// weighted by its angle as seen along the normal, summed over the corners that share position, normal,
/// coordinates and the side from which the texture is seen. A vertex whose corners differ in that is split,
/// as glTF asks by naming MikkTSpace (Mikkelsen 2008, Simulation of Wrinkled Surfaces Revisited); unlike
/// there, faces around a vertex that share no edge share its tangent too. As in glTF, normal x tangent * w
/// points against growing v, up in the picture. Where coordinates are missing or degenerate any tangent
/// orthogonal to the normal is taken. Without normals each face has its own.
void deriveTangents(Mesh& mesh, const TextureSlot& slot);

}  // namespace licht
