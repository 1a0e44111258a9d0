// The only file that knows SPIRV-Cross.
#include <fmt/format.h>
#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <array>
#include <memory>
#include <type_traits>

#include "licht/core/error.h"
#include "licht/gpu/program.h"

namespace licht::gpu {
namespace {

/// A parsed module. Everything SPIRV-Cross hands out lives as long as its context.
class Module {
public:
    explicit Module(Spirv spirv) {
        spvc_context context = nullptr;
        if (spvc_context_create(&context) != SPVC_SUCCESS) {
            throw DeviceError("SPIRV-Cross could not start");
        }
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        require(spvc_context_parse_spirv(context, spirv.data(), spirv.size(), &ir));
        require(spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                             &compiler_));
    }

    void require(spvc_result result) const {
        if (result != SPVC_SUCCESS) {
            throw DeviceError(
                fmt::format("reading SPIR-V: {}", spvc_context_get_last_error_string(context_.get())));
        }
    }

    [[nodiscard]] spvc_compiler compiler() const { return compiler_; }
    [[nodiscard]] spvc_type type(spvc_type_id id) const {
        return spvc_compiler_get_type_handle(compiler_, id);
    }

    /// Only what the entry point really uses: an included file may declare more than a kernel needs.
    [[nodiscard]] spvc_resources usedResources() const {
        spvc_set active = nullptr;
        require(spvc_compiler_get_active_interface_variables(compiler_, &active));
        spvc_resources resources = nullptr;
        require(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources, active));
        return resources;
    }

    [[nodiscard]] spvc_resources declaredResources() const {
        spvc_resources resources = nullptr;
        require(spvc_compiler_create_shader_resources(compiler_, &resources));
        return resources;
    }

    [[nodiscard]] std::span<const spvc_reflected_resource> list(spvc_resources resources,
                                                                spvc_resource_type kind) const {
        const spvc_reflected_resource* first = nullptr;
        std::size_t count = 0;
        require(spvc_resources_get_resource_list_for_type(resources, kind, &first, &count));
        return {first, count};
    }

    [[nodiscard]] std::uint32_t structSize(spvc_type type) const {
        std::size_t size = 0;
        require(spvc_compiler_get_declared_struct_size(compiler_, type, &size));
        return static_cast<std::uint32_t>(size);
    }

private:
    struct Destroy {
        void operator()(spvc_context context) const { spvc_context_destroy(context); }
    };
    std::unique_ptr<std::remove_pointer_t<spvc_context>, Destroy> context_;
    spvc_compiler compiler_ = nullptr;
};

/// How SPIRV-Cross sorts resources, as Vulkan's descriptor types: for images, and for images of dimension
/// "buffer".
struct ResourceKind {
    spvc_resource_type kind;
    VkDescriptorType type;
    VkDescriptorType texel_buffer_type;
};
constexpr std::array kResourceKinds = {
    ResourceKind{SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                 VK_DESCRIPTOR_TYPE_MAX_ENUM},
    ResourceKind{SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                 VK_DESCRIPTOR_TYPE_MAX_ENUM},
    ResourceKind{SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                 VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER},
    ResourceKind{SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                 VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
    ResourceKind{SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                 VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
    ResourceKind{SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, VK_DESCRIPTOR_TYPE_SAMPLER,
                 VK_DESCRIPTOR_TYPE_MAX_ENUM},
};

VkShaderStageFlagBits stageOf(SpvExecutionModel model) {
    switch (model) {
        case SpvExecutionModelVertex:
            return VK_SHADER_STAGE_VERTEX_BIT;
        case SpvExecutionModelFragment:
            return VK_SHADER_STAGE_FRAGMENT_BIT;
        case SpvExecutionModelGLCompute:
            return VK_SHADER_STAGE_COMPUTE_BIT;
        default:
            throw DeviceError("a shader is neither vertex, fragment nor compute");
    }
}

/// The variable's name; for a block without an instance name, the block's.
std::string nameOf(const Module& module, const spvc_reflected_resource& resource) {
    const std::string variable = spvc_compiler_get_name(module.compiler(), resource.id);
    return variable.empty() ? resource.name : variable;
}

/// Of a storage buffer, whose members may carry them, or of a storage image.
class Decorations {
public:
    Decorations(const Module& module, const spvc_reflected_resource& resource, spvc_resource_type kind)
        : module_(module), variable_(resource.id) {
        if (kind != SPVC_RESOURCE_TYPE_STORAGE_BUFFER) return;
        const SpvDecoration* first = nullptr;
        std::size_t count = 0;
        module.require(
            spvc_compiler_get_buffer_block_decorations(module.compiler(), resource.id, &first, &count));
        of_all_members_ = {first, count};
    }
    [[nodiscard]] bool has(SpvDecoration wanted) const {
        return std::find(of_all_members_.begin(), of_all_members_.end(), wanted) != of_all_members_.end() ||
               spvc_compiler_has_decoration(module_.compiler(), variable_, wanted) == SPVC_TRUE;
    }

private:
    const Module& module_;
    spvc_variable_id variable_;
    std::span<const SpvDecoration> of_all_members_;
};

ReflectedBinding describe(const Module& module, const spvc_reflected_resource& resource,
                          const ResourceKind& kind) {
    const spvc_type type = module.type(resource.type_id);
    ReflectedBinding binding;
    binding.name = nameOf(module, resource);
    if (spvc_compiler_get_decoration(module.compiler(), resource.id, SpvDecorationDescriptorSet) != 0) {
        throw DeviceError(fmt::format("'{}' is not in descriptor set 0", binding.name));
    }
    binding.binding = spvc_compiler_get_decoration(module.compiler(), resource.id, SpvDecorationBinding);
    for (unsigned i = 0; i < spvc_type_get_num_array_dimensions(type); ++i) {
        binding.count *= spvc_type_get_array_dimension(type, i);
    }
    const bool texels = kind.texel_buffer_type != VK_DESCRIPTOR_TYPE_MAX_ENUM &&
                        spvc_type_get_image_dimension(module.type(resource.base_type_id)) == SpvDimBuffer;
    binding.type = texels ? kind.texel_buffer_type : kind.type;
    if (kind.kind == SPVC_RESOURCE_TYPE_STORAGE_BUFFER || kind.kind == SPVC_RESOURCE_TYPE_STORAGE_IMAGE) {
        const Decorations decorations(module, resource, kind.kind);
        binding.read = !decorations.has(SpvDecorationNonReadable);
        binding.written = !decorations.has(SpvDecorationNonWritable);
    }
    return binding;
}

/// Finds a struct by name below the buffer blocks and lists its members.
class StructSearch {
public:
    StructSearch(const Module& module, const std::string& name) : module_(module), name_(name) {}

    /// Searches a struct type and what it holds; true when found.
    bool search(spvc_type_id id) {
        const spvc_type type = module_.type(id);
        if (name_ == spvc_compiler_get_name(module_.compiler(), spvc_type_get_base_type_id(type))) {
            found(type, module_.structSize(type));
            return true;
        }
        for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
            const spvc_type member = module_.type(spvc_type_get_member_type(type, i));
            if (spvc_type_get_basetype(member) != SPVC_BASETYPE_STRUCT) {
                continue;
            }
            if (name_ == spvc_compiler_get_name(module_.compiler(), spvc_type_get_base_type_id(member))) {
                unsigned stride = module_.structSize(member);
                if (spvc_type_get_num_array_dimensions(member) > 0) {
                    module_.require(
                        spvc_compiler_type_struct_member_array_stride(module_.compiler(), type, i, &stride));
                }
                found(member, stride);
                return true;
            }
            if (search(spvc_type_get_member_type(type, i))) {
                return true;
            }
        }
        return false;
    }

    [[nodiscard]] std::vector<ReflectedMember> take() { return std::move(members_); }

private:
    void found(spvc_type type, std::uint32_t stride) {
        members_.push_back({"", 0, stride});
        list(type, "", 0);
    }

    void list(spvc_type type, const std::string& prefix, std::uint32_t base) {
        for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
            const spvc_type member = module_.type(spvc_type_get_member_type(type, i));
            const std::string name = prefix + spvc_compiler_get_member_name(
                                                  module_.compiler(), spvc_type_get_base_type_id(type), i);
            unsigned offset = 0;
            module_.require(spvc_compiler_type_struct_member_offset(module_.compiler(), type, i, &offset));
            const bool nested = spvc_type_get_basetype(member) == SPVC_BASETYPE_STRUCT;
            if (nested && spvc_type_get_num_array_dimensions(member) == 0) {
                list(member, name + ".", base + offset);
                continue;
            }
            std::size_t size = 0;
            module_.require(
                spvc_compiler_get_declared_struct_member_size(module_.compiler(), type, i, &size));
            members_.push_back({name, base + offset, static_cast<std::uint32_t>(size)});
        }
    }

    const Module& module_;
    const std::string& name_;
    std::vector<ReflectedMember> members_;
};

}  // namespace

Reflection reflect(Spirv spirv) {
    const Module module(spirv);
    const spvc_resources resources = module.usedResources();
    Reflection reflection;
    reflection.stage = stageOf(spvc_compiler_get_execution_model(module.compiler()));
    for (const ResourceKind& kind : kResourceKinds) {
        for (const spvc_reflected_resource& resource : module.list(resources, kind.kind)) {
            reflection.bindings.push_back(describe(module, resource, kind));
            reflection.bindings.back().stages = static_cast<VkShaderStageFlags>(reflection.stage);
        }
    }
    for (const spvc_reflected_resource& push : module.list(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
        reflection.push_constant_bytes = module.structSize(module.type(push.base_type_id));
    }
    if (reflection.stage == VK_SHADER_STAGE_COMPUTE_BIT) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            reflection.local_size[axis] = spvc_compiler_get_execution_mode_argument_by_index(
                module.compiler(), SpvExecutionModeLocalSize, axis);
        }
    }
    const spvc_specialization_constant* constants = nullptr;
    std::size_t count = 0;
    module.require(spvc_compiler_get_specialization_constants(module.compiler(), &constants, &count));
    for (const spvc_specialization_constant& constant : std::span(constants, count)) {
        reflection.spec_constants.push_back(constant.constant_id);
    }
    return reflection;
}

std::vector<ReflectedMember> reflectStruct(Spirv spirv, const std::string& name) {
    const Module module(spirv);
    const spvc_resources resources = module.declaredResources();
    StructSearch search(module, name);
    for (const spvc_resource_type kind :
         {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, SPVC_RESOURCE_TYPE_UNIFORM_BUFFER,
          SPVC_RESOURCE_TYPE_PUSH_CONSTANT}) {
        for (const spvc_reflected_resource& block : module.list(resources, kind)) {
            if (search.search(block.base_type_id)) {
                return search.take();
            }
        }
    }
    return {};
}

}  // namespace licht::gpu
