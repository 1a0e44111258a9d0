#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "licht/gpu/use.h"

namespace licht::gpu {

using Spirv = std::span<const std::uint32_t>;

/// One descriptor that a shader declares, found by its name in the GLSL text. All live in set 0.
struct ReflectedBinding {
    std::string name;
    std::uint32_t binding = 0;
    std::uint32_t count = 1;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
    VkShaderStageFlags stages = 0;
    bool read = true;      ///< as the GLSL has it: not `writeonly`
    bool written = false;  ///< a storage buffer or image that is not `readonly`
};

/// What a SPIR-V module says of itself (SPIRV-Cross reads it).
struct Reflection {
    std::vector<ReflectedBinding> bindings;
    std::uint32_t push_constant_bytes = 0;
    std::uint32_t local_size[3] = {1, 1, 1};
    std::vector<std::uint32_t> spec_constants;  ///< their ids
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
};
Reflection reflect(Spirv spirv);

/// Name, offset and size of each member of the first struct called `name` that a buffer or push-constant
/// block of the module reaches (nested ones too, as "view.eye"); empty when there is none. Also the struct's
/// stride as the member "". For the test that compares records with their C++ twins.
struct ReflectedMember {
    std::string name;
    std::uint32_t offset = 0;
    std::uint32_t size = 0;
};
std::vector<ReflectedMember> reflectStruct(Spirv spirv, const std::string& name);

/// Values for specialisation constants by id (bool as 0/1). Ids that a module does not declare are ignored.
using SpecConstants = std::map<std::uint32_t, std::uint32_t>;

/// Fixed state of a raster program. Depth is reversed: nearer is greater. Viewport, scissor and cull mode are
/// dynamic. A front face goes counter-clockwise as one sees it on the screen, which is what a world-space
/// counter-clockwise triangle does under a projection that shows the world upright. Vertices are pulled from
/// storage buffers, which must be `readonly` in the vertex shader.
struct RasterState {
    std::vector<VkFormat> color_formats;
    VkFormat depth_format = VK_FORMAT_UNDEFINED;  ///< undefined: no depth
};

/// A pipeline with the layout that its SPIR-V asks for.
class Program {
public:
    Program() = default;
    static Program compute(Device& device, std::string name, Spirv shader, const SpecConstants& constants);
    static Program raster(Device& device, std::string name, Spirv vertex, Spirv fragment,
                          const RasterState& state, const SpecConstants& constants);
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    ~Program();

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] VkPipeline pipeline() const { return pipeline_; }
    [[nodiscard]] VkPipelineLayout layout() const { return layout_; }
    [[nodiscard]] VkDescriptorSetLayout setLayout() const { return set_layout_; }
    [[nodiscard]] VkPipelineBindPoint bindPoint() const { return bind_point_; }
    [[nodiscard]] const std::vector<ReflectedBinding>& bindings() const { return bindings_; }
    [[nodiscard]] std::uint32_t pushConstantBytes() const { return push_constant_bytes_; }
    [[nodiscard]] VkShaderStageFlags pushConstantStages() const { return push_constant_stages_; }
    [[nodiscard]] const std::uint32_t* localSize() const { return local_size_; }
    [[nodiscard]] double compileSeconds() const { return compile_seconds_; }

private:
    void createLayout(const std::vector<Reflection>& stages);
    void destroy() noexcept;
    Device* device_ = nullptr;
    std::string name_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineBindPoint bind_point_ = VK_PIPELINE_BIND_POINT_COMPUTE;
    std::vector<ReflectedBinding> bindings_;
    std::uint32_t push_constant_bytes_ = 0;
    VkShaderStageFlags push_constant_stages_ = 0;
    std::uint32_t local_size_[3] = {1, 1, 1};
    double compile_seconds_ = 0.0;
};

/// What a name in the shader is bound to. An array binding takes one entry per element, in order.
struct SampledImage {
    const Image* image;
    const Sampler* sampler;
};
using Resource = std::variant<const Buffer*, const TexelView*, const Image*, SampledImage>;
struct BoundResource {
    std::string name;
    Resource resource;
};

/// A descriptor set for one program, resources matched by the names in its GLSL. Throws DeviceError naming
/// program and binding when one is missing, or when vertex or fragment shaders could write it; names that the
/// program does not declare are ignored, so that one list of resources serves several programs. The resources
/// must outlive it, and may move.
class Bindings {
public:
    Bindings() = default;
    Bindings(Device& device, const Program& program, std::span<const BoundResource> resources);
    Bindings(Bindings&& other) noexcept;
    Bindings& operator=(Bindings&& other) noexcept;
    ~Bindings();
    [[nodiscard]] VkDescriptorSet set() const { return set_; }
    /// What a pass that runs the program does to each resource, as the shaders say.
    [[nodiscard]] std::span<const Use> uses() const { return uses_; }

private:
    Device* device_ = nullptr;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    std::vector<Use> uses_;
};

}  // namespace licht::gpu
