#pragma once
// The images of a picture's size, in one table: what they are called, when they exist, and how long what they
// hold is good. Allocation and bindings follow from it.
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "licht/core/math.h"
#include "licht/gpu/program.h"
#include "licht/settings/settings.h"

namespace licht {

enum class Lifetime {
    frame,      ///< every frame makes it anew
    history,    ///< since the picture last started anew, which passes see by a count of zero samples
    ping_pong,  ///< two images: this frame's and, as previous_<name>, the last one's, whatever started anew
    lent,       ///< another owns it
};

/// What passes do with it beside reading and writing texels.
enum class Target { none, color, depth };

struct ImageRow {
    std::string_view name;  ///< in the shaders
    VkFormat format;
    Target target;
    Lifetime lifetime;
    bool (*wanted)(const RenderSettings&);  ///< null: always
    std::uint32_t tiles = 1;                ///< pictures that stand side by side in it
    std::uint32_t shrink = 1;               ///< a texel for so many pixels a side
};

/// All that a renderer can call for, with the images of layers, which follow from theirs.
std::span<const ImageRow> imageTable();

/// About what a picture takes: its images on the device, and what is made of them on the host; without layers
/// of orders, which ask for themselves. Bytes.
double bytesOfPicture(uvec2 size, const RenderSettings& settings,
                      std::span<const ImageRow> table = imageTable());

class Images {
public:
    /// Those of the table's rows that the settings call for. A texel stands for each of the others, and for
    /// what is lent until it is: programs that name it and, being specialised, never touch it are bound to
    /// that.
    Images(gpu::Device& device, uvec2 size, const RenderSettings& settings,
           std::span<const ImageRow> table = imageTable());

    /// The image of that name, which must be in the table; of a pair, what this frame writes.
    [[nodiscard]] const gpu::Image& operator[](std::string_view name) const;
    [[nodiscard]] uvec2 size() const { return size_; }

    /// Under the name of a lent row.
    void lend(std::string_view name, const gpu::Image& image);

    /// By names in the shaders, for frames of that parity.
    [[nodiscard]] std::vector<gpu::BoundResource> resources(std::size_t parity) const;
    /// Kinds of frames that are bound to different images: two where there is a pair, else one.
    [[nodiscard]] std::size_t parities() const { return pairs_ ? 2 : 1; }
    /// Of this frame.
    [[nodiscard]] std::size_t parity() const { return frames_ % parities(); }
    /// Whether the previous images of pairs hold anything.
    [[nodiscard]] bool hasPrevious() const { return frames_ > 0; }
    /// The next frame begins: what this one wrote is the previous.
    void next() { ++frames_; }

private:
    struct Entry {
        const ImageRow* row;
        std::string previous_name;
        std::array<gpu::Image, 2> images;  ///< the second of a pair alone
        const gpu::Image* lent = nullptr;
    };
    [[nodiscard]] const gpu::Image& imageOf(const Entry& entry, std::size_t parity) const;

    uvec2 size_;
    gpu::Image nothing_;
    std::vector<Entry> entries_;
    bool pairs_ = false;
    std::size_t frames_ = 0;
};

}  // namespace licht
