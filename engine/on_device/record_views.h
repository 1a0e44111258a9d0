#pragma once
#include <vector>

#include "licht/gpu/program.h"
#include "licht/gpu/resource.h"

namespace licht {

/// A buffer of records by its two names in shaders/bound/scene_data.glsl. An empty buffer stands for none.
struct FetchedRecords {
    const char* block;   ///< as a storage buffer
    const char* texels;  ///< as a texel buffer
    const gpu::Buffer* buffer;
    VkFormat format = VK_FORMAT_R32G32B32A32_UINT;
};

/// All of a scene's records as texel buffers, or all as storage buffers where one is too long for a texel
/// buffer.
class RecordViews {
public:
    RecordViews() = default;
    /// `none` is bound in place of what is not there or not read. Throws InputError, with the numbers, where
    /// neither kind of buffer holds the records.
    RecordViews(gpu::Device& device, std::vector<FetchedRecords> records, const gpu::Buffer& none,
                bool storage);

    void addTo(std::vector<gpu::BoundResource>& resources) const;
    [[nodiscard]] bool inStorage() const { return in_storage_; }

private:
    std::vector<FetchedRecords> records_;
    std::vector<gpu::TexelView> views_;
    const gpu::Buffer* none_ = nullptr;
    bool in_storage_ = false;
};

}  // namespace licht
