// What passes record.
#include <fmt/format.h>

#include "licht/core/error.h"
#include "licht/gpu/commands.h"

namespace licht::gpu {
namespace {

void beginRendering(VkCommandBuffer commands, const Targets& targets, VkExtent2D extent) {
    std::vector<VkRenderingAttachmentInfo> attachments;
    for (const ColorTarget& color : targets.colors) {
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
    depth_attachment.imageView = targets.depth != nullptr ? targets.depth->view() : VK_NULL_HANDLE;
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
    info.pDepthAttachment = targets.depth != nullptr ? &depth_attachment : nullptr;
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &info.renderArea);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
}

}  // namespace

void Commands::bind(const BoundProgram& what, std::span<const std::byte> push) const {
    const Program& program = what.program;
    if (push.size() != program.pushConstantBytes()) {
        throw DeviceError(fmt::format("'{}' takes {} bytes of push constants, {} were given", program.name(),
                                      program.pushConstantBytes(), push.size()));
    }
    vkCmdBindPipeline(command_buffer_, program.bindPoint(), program.pipeline());
    const VkDescriptorSet set = what.bindings.set();
    if (set != VK_NULL_HANDLE) {
        vkCmdBindDescriptorSets(command_buffer_, program.bindPoint(), program.layout(), 0, 1, &set, 0,
                                nullptr);
    }
    if (!push.empty()) {
        vkCmdPushConstants(command_buffer_, program.layout(), program.pushConstantStages(), 0,
                           static_cast<std::uint32_t>(push.size()), push.data());
    }
}

void Commands::dispatchBytes(std::string_view name, const BoundProgram& what, std::span<const std::byte> push,
                             Threads threads) {
    const Program& program = what.program;
    const auto groups = [&](std::uint32_t wanted, int axis) {
        const std::uint32_t size = program.localSize()[axis];
        const std::uint32_t count = wanted / size + (wanted % size != 0 ? 1 : 0);
        const std::uint32_t most = device_.limits().maxComputeWorkGroupCount[axis];
        if (count > most) {
            throw DeviceError(fmt::format("'{}' asks for {} workgroups along one axis, the device allows {}",
                                          program.name(), count, most));
        }
        return count;
    };
    const std::uint32_t groups_x = groups(threads.x, 0);
    const std::uint32_t groups_y = groups(threads.y, 1);
    recordPass(name, what.bindings.uses(), {}, [&](VkCommandBuffer commands) {
        bind(what, push);
        vkCmdDispatch(commands, groups_x, groups_y, 1);
    });
}

void Commands::dispatchIndirectBytes(std::string_view name, const BoundProgram& what,
                                     std::span<const std::byte> push, const Buffer& arguments,
                                     VkDeviceSize offset) {
    const Use counted{&arguments, Access::indirect_read};
    recordPass(name, what.bindings.uses(), std::span(&counted, 1), [&](VkCommandBuffer commands) {
        bind(what, push);
        vkCmdDispatchIndirect(commands, arguments.handle(), offset);
    });
}

void Commands::drawBytes(std::string_view name, const BoundProgram& what, std::span<const std::byte> push,
                         const Targets& targets, const std::function<void(VkCommandBuffer)>& draws) {
    std::vector<Use> attached;
    VkExtent2D extent{};
    for (const ColorTarget& color : targets.colors) {
        attached.emplace_back(color.image, Access::color_target);
        extent = color.image->extent();
    }
    if (targets.depth != nullptr) {
        attached.emplace_back(targets.depth, Access::depth_target);
        extent = targets.depth->extent();
    }
    recordPass(name, what.bindings.uses(), attached, [&](VkCommandBuffer commands) {
        beginRendering(commands, targets, extent);
        bind(what, push);
        draws(commands);
        vkCmdEndRendering(commands);
    });
}

}  // namespace licht::gpu
