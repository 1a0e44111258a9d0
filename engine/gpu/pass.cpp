// What a pass may record.
#include <fmt/format.h>

#include "licht/core/error.h"
#include "licht/gpu/commands.h"

namespace licht::gpu {

VkCommandBuffer Pass::commandBuffer() const {
    return commands_.handle();
}

void Pass::bind(const Program& program, const Bindings& bindings) const {
    vkCmdBindPipeline(commandBuffer(), program.bindPoint(), program.pipeline());
    const VkDescriptorSet set = bindings.set();
    if (set != VK_NULL_HANDLE) {
        vkCmdBindDescriptorSets(commandBuffer(), program.bindPoint(), program.layout(), 0, 1, &set, 0,
                                nullptr);
    }
}

void Pass::push(const Program& program, std::span<const std::byte> bytes) const {
    if (bytes.size() != program.pushConstantBytes()) {
        throw DeviceError(fmt::format("'{}' takes {} bytes of push constants, {} were given", program.name(),
                                      program.pushConstantBytes(), bytes.size()));
    }
    if (!bytes.empty()) {
        vkCmdPushConstants(commandBuffer(), program.layout(), program.pushConstantStages(), 0,
                           static_cast<std::uint32_t>(bytes.size()), bytes.data());
    }
}

void Pass::dispatchBytes(const Program& program, const Bindings& bindings,
                         std::span<const std::byte> push_constants, std::uint32_t threads_x,
                         std::uint32_t threads_y) const {
    const auto groups = [&](std::uint32_t threads, int axis) {
        const std::uint32_t size = program.localSize()[axis];
        const std::uint32_t count = threads / size + (threads % size != 0 ? 1 : 0);
        const std::uint32_t most = commands_.device().limits().maxComputeWorkGroupCount[axis];
        if (count > most) {
            throw DeviceError(fmt::format("'{}' asks for {} workgroups along one axis, the device allows {}",
                                          program.name(), count, most));
        }
        return count;
    };
    const std::uint32_t groups_x = groups(threads_x, 0);
    const std::uint32_t groups_y = groups(threads_y, 1);
    bind(program, bindings);
    push(program, push_constants);
    vkCmdDispatch(commandBuffer(), groups_x, groups_y, 1);
}

void Pass::render(std::span<const ColorTarget> colors, const Image* depth,
                  const std::function<void()>& draws) const {
    VkExtent2D extent = depth != nullptr ? depth->extent() : VkExtent2D{};
    std::vector<VkRenderingAttachmentInfo> attachments;
    for (const ColorTarget& color : colors) {
        extent = color.image->extent();
        VkRenderingAttachmentInfo attachment{};
        attachment.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        attachment.imageView = color.image->view();
        attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachment.clearValue.color = color.clear;
        attachments.push_back(attachment);
    }
    VkRenderingAttachmentInfo depth_attachment{};
    depth_attachment.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    depth_attachment.imageView = depth != nullptr ? depth->view() : VK_NULL_HANDLE;
    depth_attachment.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth_attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth_attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth_attachment.clearValue.depthStencil = {0.0F, 0};

    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = {{0, 0}, extent};
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pColorAttachments = attachments.data();
    info.pDepthAttachment = depth != nullptr ? &depth_attachment : nullptr;
    vkCmdBeginRendering(commandBuffer(), &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    vkCmdSetViewport(commandBuffer(), 0, 1, &viewport);
    vkCmdSetScissor(commandBuffer(), 0, 1, &info.renderArea);
    vkCmdSetCullMode(commandBuffer(), VK_CULL_MODE_NONE);
    draws();
    vkCmdEndRendering(commandBuffer());
}

}  // namespace licht::gpu
