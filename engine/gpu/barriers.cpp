// From uses to barriers.
#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/gpu/commands.h"

namespace licht::gpu {
namespace {

struct AccessInfo {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 reads;
    VkAccessFlags2 writes;
    VkImageLayout layout;  ///< of an image
};

/// The one place that says what an Access means.
AccessInfo accessInfo(Access access, bool image) {
    constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 kRaster =
        VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    constexpr VkPipelineStageFlags2 kDepth =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    // Texel buffers count as sampled.
    const VkAccessFlags2 shader_read = image ? VK_ACCESS_2_SHADER_STORAGE_READ_BIT
                                             : VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                                   VK_ACCESS_2_SHADER_SAMPLED_READ_BIT |
                                                   VK_ACCESS_2_UNIFORM_READ_BIT;
    const VkAccessFlags2 raster_read = image ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT : shader_read;
    constexpr VkAccessFlags2 kShaderWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    switch (access) {
        case Access::compute_read:
            return {kCompute, shader_read, 0, VK_IMAGE_LAYOUT_GENERAL};
        case Access::compute_write:
            return {kCompute, 0, kShaderWrite, VK_IMAGE_LAYOUT_GENERAL};
        case Access::compute_read_write:
            return {kCompute, shader_read, kShaderWrite, VK_IMAGE_LAYOUT_GENERAL};
        case Access::compute_sample:
            return {kCompute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        case Access::indirect_read:
            return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::raster_read:
            return {kRaster, raster_read, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        case Access::color_target:
            return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        case Access::depth_target:
            return {kDepth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
        case Access::transfer_read:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
        case Access::transfer_write:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
        case Access::present:
            break;
    }
    // Presentation waits for a semaphore, which is all the visibility it needs.
    return {VK_PIPELINE_STAGE_2_NONE, 0, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
}

/// One side of a dependency each.
struct Scopes {
    VkPipelineStageFlags2 from_stages = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 from_access = VK_ACCESS_2_NONE;
    VkPipelineStageFlags2 to_stages = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 to_access = VK_ACCESS_2_NONE;
    bool needed = false;
};

/// What must be waited for before this access, and the state of the resource after it. A change of layout
/// counts as a write.
Scopes advance(ResourceState& state, const AccessInfo& use, bool new_layout) {
    Scopes scopes;
    scopes.from_stages = state.write_stages;
    scopes.from_access = state.write_access;
    scopes.to_stages = use.stages;
    scopes.to_access = use.reads | use.writes;
    if (use.writes != 0 || new_layout) {
        scopes.from_stages |= state.read_stages;
        scopes.needed = new_layout || scopes.from_stages != VK_PIPELINE_STAGE_2_NONE;
        state.write_stages = use.stages;
        state.write_access = use.writes;
        state.read_stages = use.writes != 0 ? VK_PIPELINE_STAGE_2_NONE : use.stages;
        // A new layout is visible to the reader it was made for; a write is visible to nobody yet.
        state.seen_stages = use.writes != 0 ? VK_PIPELINE_STAGE_2_NONE : use.stages;
        state.seen_access = use.writes != 0 ? VK_ACCESS_2_NONE : use.reads;
        return scopes;
    }
    const bool seen = (use.stages & ~state.seen_stages) == 0 && (use.reads & ~state.seen_access) == 0;
    scopes.needed = state.write_stages != VK_PIPELINE_STAGE_2_NONE && !seen;
    if (scopes.needed) {
        // The barrier covers earlier readers again, so that every seen stage has seen every seen access.
        state.seen_stages |= use.stages;
        state.seen_access |= use.reads;
        scopes.to_stages = state.seen_stages;
        scopes.to_access = state.seen_access;
    }
    state.read_stages |= use.stages;
    return scopes;
}

/// Each resource once, with the sum of what the pass does to it.
struct MergedUse {
    Tracked* resource = nullptr;
    AccessInfo access{};
};

std::vector<MergedUse> merge(std::span<const Use> bound, std::span<const Use> stated) {
    std::vector<MergedUse> merged;
    merged.reserve(bound.size() + stated.size());
    const auto add = [&merged](const Use& use) {
        const AccessInfo access = accessInfo(use.access, use.resource->image != VK_NULL_HANDLE);
        const auto known = std::find_if(merged.begin(), merged.end(), [&](const MergedUse& other) {
            return other.resource == use.resource;
        });
        if (known == merged.end()) {
            merged.push_back({use.resource, access});
            return;
        }
        if (use.resource->image != VK_NULL_HANDLE && known->access.layout != access.layout) {
            throw DeviceError(
                fmt::format("a pass uses the image '{}' in two layouts at once", use.resource->name));
        }
        known->access.stages |= access.stages;
        known->access.reads |= access.reads;
        known->access.writes |= access.writes;
    };
    std::for_each(bound.begin(), bound.end(), add);
    std::for_each(stated.begin(), stated.end(), add);
    return merged;
}

VkBufferMemoryBarrier2 bufferBarrier(const Tracked& resource, const Scopes& scopes) {
    VkBufferMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
    barrier.srcStageMask = scopes.from_stages;
    barrier.srcAccessMask = scopes.from_access;
    barrier.dstStageMask = scopes.to_stages;
    barrier.dstAccessMask = scopes.to_access;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.buffer = resource.buffer;
    barrier.size = VK_WHOLE_SIZE;
    return barrier;
}

VkImageMemoryBarrier2 imageBarrier(const Tracked& resource, const Scopes& scopes, VkImageLayout old_layout) {
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = scopes.from_stages;
    barrier.srcAccessMask = scopes.from_access;
    barrier.dstStageMask = scopes.to_stages;
    barrier.dstAccessMask = scopes.to_access;
    barrier.oldLayout = old_layout;
    barrier.newLayout = resource.state.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = resource.image;
    barrier.subresourceRange = {resource.aspect, 0, 1, 0, 1};
    return barrier;
}

}  // namespace

void Commands::barrier(std::span<const Use> bound, std::span<const Use> stated) {
    std::vector<VkBufferMemoryBarrier2> buffers;
    std::vector<VkImageMemoryBarrier2> images;
    for (const MergedUse& use : merge(bound, stated)) {
        Tracked& resource = *use.resource;
        const bool image = resource.image != VK_NULL_HANDLE;
        const VkImageLayout old_layout = resource.state.layout;
        const Scopes scopes = advance(resource.state, use.access, image && old_layout != use.access.layout);
        if (image) resource.state.layout = use.access.layout;
        if (!scopes.needed) continue;
        if (image)
            images.push_back(imageBarrier(resource, scopes, old_layout));
        else
            buffers.push_back(bufferBarrier(resource, scopes));
    }
    if (buffers.empty() && images.empty()) {
        return;
    }
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffers.size());
    info.pBufferMemoryBarriers = buffers.data();
    info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size());
    info.pImageMemoryBarriers = images.data();
    vkCmdPipelineBarrier2(command_buffer_, &info);
}

void Commands::makeVisibleToHost(std::span<const Buffer* const> buffers) {
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    for (const Buffer* buffer : buffers) {
        barrier.srcStageMask |= buffer->tracked().state.write_stages;
        barrier.srcAccessMask |= buffer->tracked().state.write_access;
    }
    if (barrier.srcStageMask == VK_PIPELINE_STAGE_2_NONE) {
        return;
    }
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(command_buffer_, &info);
}

}  // namespace licht::gpu
