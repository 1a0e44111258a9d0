#include "licht/on_device/record_views.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/gpu/device.h"

namespace licht {

RecordViews::RecordViews(gpu::Device& device, std::vector<FetchedRecords> records, const gpu::Buffer& none,
                         bool storage)
    : records_(std::move(records)), none_(&none) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    in_storage_ = storage || std::any_of(records_.begin(), records_.end(), [&](const FetchedRecords& r) {
                      return r.buffer->size() / gpu::texelBytes(r.format) > limits.maxTexelBufferElements;
                  });
    views_.reserve(records_.size());
    for (const FetchedRecords& r : records_) {
        if (in_storage_ && r.buffer->size() > limits.maxStorageBufferRange)
            throw InputError(fmt::format(
                "the scene's {} take {} bytes, and this device's buffers hold at most {} texels or {} bytes",
                r.buffer->name(), r.buffer->size(), limits.maxTexelBufferElements,
                limits.maxStorageBufferRange));
        views_.emplace_back(device, *r.buffer && !in_storage_ ? *r.buffer : none, r.format);
    }
}

void RecordViews::addTo(std::vector<gpu::BoundResource>& resources) const {
    for (std::size_t i = 0; i < records_.size(); ++i) {
        const FetchedRecords& r = records_[i];
        resources.push_back({r.texels, &views_[i]});
        resources.push_back({r.block, *r.buffer && in_storage_ ? r.buffer : none_});
    }
}

}  // namespace licht
