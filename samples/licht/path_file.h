#pragma once
// A camera's path as a file tells it: keys in time.
#include <filesystem>
#include <vector>

#include "licht/scene/scene.h"

namespace licht {

struct CameraKey {
    double seconds = 0.0;
    Camera camera;     ///< from here
    bool cut = false;  ///< seen all at once, where others are moved to
};

/// Cameras at times that grow.
class CameraKeys {
public:
    /// At least one key.
    explicit CameraKeys(std::vector<CameraKey> keys);

    /// Eye, turn and angle between the two keys beside, evenly: positions linear, turns about one axis
    /// (Shoemake 1985, Animating Rotation with Quaternion Curves). Before the first key and behind the last
    /// it rests, and it waits for a cut.
    [[nodiscard]] Camera at(double seconds) const;
    /// Whether there is a cut after `before`, and not after `seconds`.
    [[nodiscard]] bool cutsBetween(double before, double seconds) const;

private:
    [[nodiscard]] std::vector<CameraKey>::const_iterator firstBehind(double seconds) const;

    std::vector<CameraKey> keys_;
};

/// Throws InputError naming file and key.
CameraKeys readPathFile(const std::filesystem::path& path, const Scene& scene, const Camera& start);

}  // namespace licht
