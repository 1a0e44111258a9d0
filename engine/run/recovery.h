#pragma once
// How long pictures are worse, behind a change, than those of a history that began with it.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "licht/run/disocclusion.h"

namespace licht {

enum class ChangeKind : std::uint32_t { cut, light, disocclusion, kCount };
/// In the order of ChangeKind.
inline constexpr std::array<std::string_view, 3> kChangeNames{"cut", "light", "disocclusion"};
static_assert(kChangeNames.size() == static_cast<std::size_t>(ChangeKind::kCount));

/// So many frames are watched from a change on.
inline constexpr std::uint32_t kWatchedFrames = 16;
/// Error over that of a fresh start from which on a change is over.
inline constexpr double kRecovered = 1.1;
/// The light changed where the mean of a picture did by more than that from a frame to the next.
inline constexpr double kChangeOfLight = 0.1;

/// So many frames behind a change: relative squared errors, sums over the pixels that it touched, without
/// what the truth is off by itself.
struct RecoveryStep {
    double error = 0.0;
    double fresh_error = 0.0;  ///< of the history that began with the change
    std::uint64_t pixels = 0;
};

struct Recovery {
    std::vector<RecoveryStep> steps;  ///< the change's own frame first

    void add(std::uint32_t frames_since, const RecoveryStep& step);
    /// After so many frames the error is that of a fresh start; none: not in those watched, or of no pixel.
    [[nodiscard]] std::optional<std::uint32_t> frames() const;
};
using Recoveries = std::array<Recovery, kChangeNames.size()>;

/// For each pixel since how many frames its surface is seen.
class SurfaceAges {
public:
    static constexpr std::uint32_t kUnknown = ~0U;  ///< nothing is there, or it was there from the beginning

    /// The next frame; `before`: nothing where all is new.
    void advance(const std::optional<SeenDepths>& before, const SeenDepths& now);
    [[nodiscard]] std::span<const std::uint32_t> ages() const { return ages_; }

private:
    std::vector<std::uint32_t> ages_;
};

/// When histories that are compared with begin anew: with each change of the whole picture, and where none is
/// watched with what comes into sight.
class FreshStarts {
public:
    /// The next frame, and how that follows the one before.
    void advance(bool cut, bool light_changed, bool uncovered);
    /// Whether a change is watched.
    [[nodiscard]] bool watches() const { return since_ < kWatchedFrames; }
    [[nodiscard]] bool begins() const { return since_ == 0; }
    [[nodiscard]] std::uint32_t framesSince() const { return since_; }
    /// What it began with.
    [[nodiscard]] ChangeKind kind() const { return kind_; }
    /// Whether the change touched a pixel whose surface is seen since so many frames.
    [[nodiscard]] bool touched(std::uint32_t age) const;

private:
    std::uint32_t since_ = kWatchedFrames;
    ChangeKind kind_ = ChangeKind::disocclusion;
};

}  // namespace licht
