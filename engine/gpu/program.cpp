#include "licht/gpu/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "licht/core/clock.h"
#include "licht/core/error.h"

namespace licht::gpu {
namespace {

class ShaderModule {
public:
    ShaderModule(Device& device, Spirv spirv, const std::string& program) : device_(device) {
        VkShaderModuleCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        info.codeSize = spirv.size_bytes();
        info.pCode = spirv.data();
        check(vkCreateShaderModule(device.handle(), &info, nullptr, &module_),
              fmt::format("creating a shader of '{}'", program));
        device.setName(VK_OBJECT_TYPE_SHADER_MODULE, std::bit_cast<std::uint64_t>(module_), program);
    }
    ShaderModule(const ShaderModule&) = delete;
    ShaderModule& operator=(const ShaderModule&) = delete;
    ~ShaderModule() { vkDestroyShaderModule(device_.handle(), device_.unlessGivenUp(module_), nullptr); }
    [[nodiscard]] VkShaderModule handle() const { return module_; }

private:
    Device& device_;
    VkShaderModule module_ = VK_NULL_HANDLE;
};

/// The constants that one stage declares, in the form that Vulkan wants.
class Specialization {
public:
    Specialization(const Reflection& stage, const SpecConstants& constants) {
        for (const auto& [id, value] : constants) {
            if (std::find(stage.spec_constants.begin(), stage.spec_constants.end(), id) !=
                stage.spec_constants.end()) {
                entries_.push_back(
                    {id, static_cast<std::uint32_t>(values_.size() * sizeof(value)), sizeof(value)});
                values_.push_back(value);
            }
        }
        info_.mapEntryCount = static_cast<std::uint32_t>(entries_.size());
        info_.pMapEntries = entries_.data();
        info_.dataSize = values_.size() * sizeof(std::uint32_t);
        info_.pData = values_.data();
    }
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;
    ~Specialization() = default;
    [[nodiscard]] const VkSpecializationInfo* info() const { return &info_; }

private:
    std::vector<VkSpecializationMapEntry> entries_;
    std::vector<std::uint32_t> values_;
    VkSpecializationInfo info_{};
};

VkPipelineShaderStageCreateInfo stageInfo(const Reflection& stage, const ShaderModule& module,
                                          const Specialization& specialization) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage.stage;
    info.module = module.handle();
    info.pName = "main";
    info.pSpecializationInfo = specialization.info();
    return info;
}

void requireStage(const Reflection& stage, VkShaderStageFlagBits wanted, const std::string& program) {
    if (stage.stage != wanted) {
        throw DeviceError(fmt::format("'{}' was given a shader of the wrong stage", program));
    }
}

VkPipelineRasterizationStateCreateInfo rasterizationInfo() {
    VkPipelineRasterizationStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    info.polygonMode = VK_POLYGON_MODE_FILL;
    info.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    info.lineWidth = 1.0F;
    return info;
}

VkPipelineDepthStencilStateCreateInfo depthInfo(bool has_depth) {
    VkPipelineDepthStencilStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    info.depthTestEnable = has_depth ? VK_TRUE : VK_FALSE;
    info.depthWriteEnable = info.depthTestEnable;
    info.depthCompareOp = VK_COMPARE_OP_GREATER;
    return info;
}

}  // namespace

void Program::createLayout(const std::vector<Reflection>& stages) {
    for (const Reflection& stage : stages) {
        for (const ReflectedBinding& found : stage.bindings) {
            const auto known = std::find_if(
                bindings_.begin(), bindings_.end(),
                [&](const ReflectedBinding& binding) { return binding.binding == found.binding; });
            if (known == bindings_.end()) {
                bindings_.push_back(found);
            } else if (known->name == found.name && known->type == found.type &&
                       known->count == found.count) {
                known->stages |= found.stages;
                known->read = known->read || found.read;
                known->written = known->written || found.written;
            } else {
                throw DeviceError(fmt::format("'{}': binding {} is both '{}' and '{}'", name_, found.binding,
                                              known->name, found.name));
            }
        }
        if (stage.push_constant_bytes > 0) {
            push_constant_bytes_ = std::max(push_constant_bytes_, stage.push_constant_bytes);
            push_constant_stages_ |= static_cast<VkShaderStageFlags>(stage.stage);
        }
    }

    std::vector<VkDescriptorSetLayoutBinding> set_bindings;
    for (const ReflectedBinding& binding : bindings_) {
        set_bindings.push_back({binding.binding, binding.type, binding.count, binding.stages, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = static_cast<std::uint32_t>(set_bindings.size());
    set.pBindings = set_bindings.data();
    check(vkCreateDescriptorSetLayout(device_->handle(), &set, nullptr, &set_layout_),
          fmt::format("creating the set layout of '{}'", name_));

    const VkPushConstantRange range{push_constant_stages_, 0, push_constant_bytes_};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    layout.pushConstantRangeCount = push_constant_bytes_ > 0 ? 1 : 0;
    layout.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device_->handle(), &layout, nullptr, &layout_),
          fmt::format("creating the pipeline layout of '{}'", name_));
}

Program Program::compute(Device& device, std::string name, Spirv shader, const SpecConstants& constants) {
    const Clock::time_point start = Clock::now();
    const Reflection stage = reflect(shader);
    Program program;
    program.device_ = &device;
    program.name_ = std::move(name);
    requireStage(stage, VK_SHADER_STAGE_COMPUTE_BIT, program.name_);
    std::copy(std::begin(stage.local_size), std::end(stage.local_size), std::begin(program.local_size_));
    const std::uint64_t invocations =
        std::uint64_t{stage.local_size[0]} * stage.local_size[1] * stage.local_size[2];
    if (invocations > device.limits().maxComputeWorkGroupInvocations) {
        throw DeviceError(fmt::format("'{}' has workgroups of {} invocations, the device allows {}",
                                      program.name_, invocations,
                                      device.limits().maxComputeWorkGroupInvocations));
    }
    program.createLayout({stage});

    const ShaderModule module(device, shader, program.name_);
    const Specialization specialization(stage, constants);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stageInfo(stage, module, specialization);
    info.layout = program.layout_;
    device.tellCompiling(program.name_);
    check(vkCreateComputePipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr,
                                   &program.pipeline_),
          fmt::format("compiling '{}'", program.name_));
    device.setName(VK_OBJECT_TYPE_PIPELINE, std::bit_cast<std::uint64_t>(program.pipeline_), program.name_);
    program.compile_seconds_ = secondsSince(start);
    return program;
}

Program Program::raster(Device& device, std::string name, Spirv vertex, Spirv fragment,
                        const RasterState& state, const SpecConstants& constants) {
    const Clock::time_point start = Clock::now();
    const Reflection vertex_stage = reflect(vertex);
    const Reflection fragment_stage = reflect(fragment);
    Program program;
    program.device_ = &device;
    program.name_ = std::move(name);
    program.bind_point_ = VK_PIPELINE_BIND_POINT_GRAPHICS;
    requireStage(vertex_stage, VK_SHADER_STAGE_VERTEX_BIT, program.name_);
    requireStage(fragment_stage, VK_SHADER_STAGE_FRAGMENT_BIT, program.name_);
    program.createLayout({vertex_stage, fragment_stage});

    const ShaderModule vertex_module(device, vertex, program.name_);
    const ShaderModule fragment_module(device, fragment, program.name_);
    const Specialization vertex_constants(vertex_stage, constants);
    const Specialization fragment_constants(fragment_stage, constants);
    const std::array stages = {stageInfo(vertex_stage, vertex_module, vertex_constants),
                               stageInfo(fragment_stage, fragment_module, fragment_constants)};

    // Vertices are pulled from storage buffers.
    VkPipelineVertexInputStateCreateInfo vertex_input{};
    vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    const VkPipelineRasterizationStateCreateInfo rasterization = rasterizationInfo();
    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    const VkPipelineDepthStencilStateCreateInfo depth = depthInfo(state.depth_format != VK_FORMAT_UNDEFINED);

    VkPipelineColorBlendAttachmentState overwrite{};
    overwrite.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                               VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(state.color_formats.size(), overwrite);
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    blend.pAttachments = attachments.data();

    constexpr std::array kDynamic = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                     VK_DYNAMIC_STATE_CULL_MODE};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(kDynamic.size());
    dynamic.pDynamicStates = kDynamic.data();

    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(state.color_formats.size());
    rendering.pColorAttachmentFormats = state.color_formats.data();
    rendering.depthAttachmentFormat = state.depth_format;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertex_input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = program.layout_;
    device.tellCompiling(program.name_);
    check(vkCreateGraphicsPipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr,
                                    &program.pipeline_),
          fmt::format("compiling '{}'", program.name_));
    device.setName(VK_OBJECT_TYPE_PIPELINE, std::bit_cast<std::uint64_t>(program.pipeline_), program.name_);
    program.compile_seconds_ = secondsSince(start);
    return program;
}

Program::Program(Program&& other) noexcept {
    *this = std::move(other);
}

Program& Program::operator=(Program&& other) noexcept {
    if (this != &other) {
        destroy();
        device_ = other.device_;
        name_ = std::move(other.name_);
        pipeline_ = std::exchange(other.pipeline_, VK_NULL_HANDLE);
        layout_ = std::exchange(other.layout_, VK_NULL_HANDLE);
        set_layout_ = std::exchange(other.set_layout_, VK_NULL_HANDLE);
        bind_point_ = other.bind_point_;
        bindings_ = std::move(other.bindings_);
        push_constant_bytes_ = other.push_constant_bytes_;
        push_constant_stages_ = other.push_constant_stages_;
        std::copy(std::begin(other.local_size_), std::end(other.local_size_), std::begin(local_size_));
        compile_seconds_ = other.compile_seconds_;
    }
    return *this;
}

Program::~Program() {
    destroy();
}

void Program::destroy() noexcept {
    if (device_ != nullptr) {
        vkDestroyPipeline(device_->handle(), device_->unlessGivenUp(pipeline_), nullptr);
        vkDestroyPipelineLayout(device_->handle(), device_->unlessGivenUp(layout_), nullptr);
        vkDestroyDescriptorSetLayout(device_->handle(), device_->unlessGivenUp(set_layout_), nullptr);
    }
}

}  // namespace licht::gpu
