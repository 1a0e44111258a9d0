#pragma once
// Small glTF files and their pictures: a quad that faces the camera, with what a file says of it.
#include <array>
#include <string>
#include <vector>

#include "licht/film/film.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"
#include "support/gltf_file.h"

namespace licht::test {

/// Corners, counter-clockwise from the lower left as the camera sees them.
inline constexpr std::array<std::array<float, 2>, 4> kQuadCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

class GltfPicture {
public:
    /// Adds the quad [-1,1]^2 at z = 0 that faces +Z, with normals and TEXCOORD_0 (u to the right, v down),
    /// on a node of its own; returns the node's index. `more`: further attributes, name -> accessor.
    int addQuad(const Json& material, const Json& node = Json::object(), const Json& more = Json::object());
    /// An accessor with that value at each of the quad's corners; returns its index.
    int atEveryCorner(const std::array<float, 4>& value);
    /// An image of RGBA codes, row by row, and a texture that reads it; returns the texture's index.
    int addTexture(int width, int height, const std::vector<std::array<int, 4>>& texels,
                   const Json& sampler = Json::object());
    /// Lambertian: no specular layer. `more` is merged in (RFC 7386).
    static Json matte(const Json& more = Json::object());

    /// As loaded.
    [[nodiscard]] Scene scene() const;

    GltfFile file;

private:
    TemporaryFolder folder_;
    int images_ = 0;
};

/// Looks along -Z on [-half, half]^2, from z = height.
Camera frontCamera(float half = 0.5F, float height = 3.0F);
/// Gives pi lx to a surface that faces `towards` (any length): a white Lambertian one shows the cosine.
PunctualLight sunFrom(const vec3& towards);

/// 16 x 16 pixels of one bounce.
RenderSettings smallPicture();

/// Demands that value in all channels of all pixels, to a share of it.
void expectEverywhere(const Film& film, const glm::dvec3& exact, double share);

}  // namespace licht::test
