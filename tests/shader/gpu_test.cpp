#include "support/gpu_test.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <optional>
#include <thread>

#include "licht/core/error.h"
#include "licht/gpu/commands.h"
#include "licht/gpu/device_select.h"
#include "licht/gpu/pieces.h"
#include "licht/gpu/upload_image.h"
#include "licht/spirv/gpu_access_comp.h"
#include "licht/spirv/gpu_everything_comp.h"
#include "licht/spirv/gpu_sample_comp.h"
#include "licht/spirv/gpu_step_comp.h"
#include "licht/spirv/gpu_texels_comp.h"
#include "licht/spirv/gpu_triangle_frag.h"
#include "licht/spirv/gpu_triangle_vert.h"
#include "licht/spirv/gpu_writes_frag.h"

namespace licht::gpu {
namespace {

constexpr VkBufferUsageFlags kStorage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

template <typename T>
std::vector<T> as(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

template <typename T>
Buffer upload(const std::string& name, const std::vector<T>& values, VkBufferUsageFlags usage = kStorage) {
    return uploadBuffer(testDevice(), name, std::span<const T>(values), usage);
}

template <typename Exception, typename Function>
std::string textOf(const Function& function) {
    try {
        function();
    } catch (const Exception& error) {
        return error.what();
    }
    return "nothing was thrown";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Buffer, ofManyPiecesComesBack) {
    std::vector<std::uint32_t> values(2 * kPieceBytes / 4 + 1001);
    std::iota(values.begin(), values.end(), 7U);
    EXPECT_TRUE(as<std::uint32_t>(readBuffer(testDevice(), upload("numbers", values))) == values);
}

TEST(Image, ofManyPiecesComesBack) {
    // Rows of which no whole number makes a piece.
    const VkExtent2D extent{3000, 7000};
    std::vector<std::uint32_t> values(std::size_t{extent.width} * extent.height);
    std::iota(values.begin(), values.end(), 7U);
    const Image image = uploadImage(testDevice(), "numbers", extent, VK_FORMAT_R8G8B8A8_UNORM,
                                    std::as_bytes(std::span(values)),
                                    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    EXPECT_TRUE(as<std::uint32_t>(readImage(testDevice(), image)) == values);
}

TEST(Buffer, uploadedBytesComeBack) {
    std::vector<std::uint32_t> values(100'003);
    std::iota(values.begin(), values.end(), 7U);
    const std::uint64_t before = testDevice().deviceBytes();
    {
        const Buffer buffer = upload("numbers", values);
        EXPECT_EQ(as<std::uint32_t>(readBuffer(testDevice(), buffer)), values);
        EXPECT_GE(testDevice().deviceBytes(), before + values.size() * 4);
    }
    EXPECT_EQ(testDevice().deviceBytes(), before);
    EXPECT_GE(testDevice().devicePeakBytes(), before + values.size() * 8) << "the staging copy counts too";
}

TEST(Buffer, emptyOnesHoldSixteenBytes) {
    const Buffer buffer =
        upload("empty", std::vector<float>{}, kStorage | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    EXPECT_EQ(buffer.size(), 16U);
    EXPECT_EQ(readBuffer(testDevice(), buffer).size(), 16U);
    const TexelView view(testDevice(), buffer, VK_FORMAT_R32G32B32A32_SFLOAT);
    EXPECT_NE(view.handle(), VkBufferView{});
}

TEST(Buffer, movesKeepOneOwner) {
    Buffer first = upload("moved", std::vector<std::uint32_t>{1, 2, 3, 4});
    Buffer second = std::move(first);
    first = upload("other", std::vector<std::uint32_t>{5, 6, 7, 8});
    second = std::move(first);
    EXPECT_EQ(as<std::uint32_t>(readBuffer(testDevice(), second)), (std::vector<std::uint32_t>{5, 6, 7, 8}));
}

TEST(Image, tooLargeSaysTheNumbers) {
    const std::uint32_t size = testDevice().limits().maxImageDimension2D + 1;
    const std::string text = textOf<DeviceError>([&] {
        const Image image(testDevice(), "huge", {size, 1}, VK_FORMAT_R32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
    });
    EXPECT_TRUE(contains(text, "'huge'") && contains(text, std::to_string(size))) << text;
}

TEST(Reflect, namesTypesAndSizesComeFromTheModule) {
    const Reflection reflection = reflect(gpu_everything_comp);
    EXPECT_EQ(reflection.push_constant_bytes, 12U);
    EXPECT_EQ(reflection.local_size[0], 8U);
    EXPECT_EQ(reflection.local_size[1], 4U);
    EXPECT_EQ(reflection.spec_constants, (std::vector<std::uint32_t>{3, 4}));
    std::map<std::string, std::pair<VkDescriptorType, std::uint32_t>> found;
    for (const ReflectedBinding& binding : reflection.bindings) {
        found[binding.name] = {binding.type, binding.count};
    }
    const std::map<std::string, std::pair<VkDescriptorType, std::uint32_t>> expected = {
        {"table", {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1}},
        {"settings", {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}},
        {"Items", {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1}},
        {"result", {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1}},
        {"picture", {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1}},
        {"pages", {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3}},
    };
    EXPECT_EQ(found, expected) << "what is declared and not used needs no resource";
}

TEST(Reflect, readsAndWritesComeFromTheModule) {
    std::map<std::string, std::string> found;
    for (const ReflectedBinding& binding : reflect(gpu_access_comp).bindings) {
        found[binding.name] = std::string(binding.read ? "r" : "") + (binding.written ? "w" : "");
    }
    const std::map<std::string, std::string> expected = {
        {"texels", "r"},         {"sampled", "r"},         {"uniforms", "r"},      {"read_buffer", "r"},
        {"written_buffer", "w"}, {"changed_buffer", "rw"}, {"mixed_buffer", "rw"}, {"read_image", "r"},
        {"written_image", "w"},  {"changed_image", "rw"},  {"read_texels", "r"},   {"written_texels", "w"}};
    EXPECT_EQ(found, expected);
}

TEST(Reflect, structsAreFoundWithStd430Offsets) {
    std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> found;
    for (const ReflectedMember& member : reflectStruct(gpu_everything_comp, "Item")) {
        found[member.name] = {member.offset, member.size};
    }
    const std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> expected = {
        {"", {0, 48}},
        {"color", {0, 16}},
        {"inner.direction", {16, 12}},
        {"inner.reach", {28, 4}},
        {"flags", {32, 4}}};
    EXPECT_EQ(found, expected);
    EXPECT_EQ(reflectStruct(gpu_everything_comp, "Inner").size(), 3U);
    EXPECT_EQ(reflectStruct(gpu_everything_comp, "Push").size(), 3U);
    EXPECT_TRUE(reflectStruct(gpu_everything_comp, "Nowhere").empty());
}

struct ItemRecord {
    float color[4];
    float direction[3];
    float reach;
    std::uint32_t flags;
    std::uint32_t padding[3];
};

TEST(Compute, oneOfEverything) {
    Device& device = testDevice();
    constexpr std::uint32_t kWidth = 21;  // no multiple of the workgroup
    constexpr std::uint32_t kHeight = 9;
    std::vector<float> texels(std::size_t{kWidth} * kHeight * 4);
    std::iota(texels.begin(), texels.end(), 0.0F);
    const Buffer table = upload("table", texels, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    const TexelView table_view(device, table, VK_FORMAT_R32G32B32A32_SFLOAT);
    const Buffer items = upload("items", std::vector<ItemRecord>(2, {{}, {}, 0.5F, 32, {}}));
    const Buffer page_a = upload("page a", std::vector<std::uint32_t>{100});
    const Buffer page_b = upload("page b", std::vector<std::uint32_t>{1000});
    const Buffer settings(device, "settings", 16, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Memory::host_write);
    const float offset[4] = {0.0F, 0.0F, 0.25F, 0.0F};
    std::memcpy(settings.mapped(), offset, sizeof(offset));
    const Buffer result(device, "result", std::size_t{kWidth} * kHeight * 4, kStorage, Memory::device);
    const Image picture(device, "picture", {kWidth, kHeight}, VK_FORMAT_R32_SFLOAT,
                        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);

    const Program program =
        Program::compute(device, "everything", gpu_everything_comp, {{3, 2}, {4, 1}, {77, 5}});
    EXPECT_GT(program.compileSeconds(), 0.0);
    // Two of three pages: the last one fills the array. A name that the kernel does not know is ignored.
    const std::vector<BoundResource> resources = {
        {"table", &table_view}, {"settings", &settings}, {"Items", &items},  {"result", &result},
        {"picture", &picture},  {"pages", &page_a},      {"pages", &page_b}, {"stranger", &page_a}};
    const Bindings bindings(device, program, resources);
    struct {
        std::uint32_t size[2] = {kWidth, kHeight};
        float scale = 2.0F;
    } push;
    Commands commands(device);
    commands.begin();
    commands.dispatch("everything", {program, bindings}, push, {kWidth, kHeight});
    commands.submit();
    commands.wait();

    const auto values = as<float>(readBuffer(device, result));
    const auto pixels = as<float>(readImage(device, picture));
    ASSERT_EQ(pixels.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        // Sums of small multiples of a quarter: exact.
        const float expected =
            -((4.0F * static_cast<float>(i) + 1.0F) * 2.0F + 0.25F + 2.0F + 32.5F + 2100.0F);
        ASSERT_EQ(values[i], expected) << i;
        ASSERT_EQ(pixels[i], static_cast<float>(i)) << i;
    }
}

TEST(Compute, misuseNamesTheCulprit) {
    Device& device = testDevice();
    const Program program = Program::compute(device, "step", gpu_step_comp, {});
    const Buffer buffer = upload("numbers", std::vector<std::uint32_t>(64));
    const Image image(device, "picture", {4, 4}, VK_FORMAT_R32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
    const auto bindingError = [&](const std::vector<BoundResource>& resources) {
        return textOf<DeviceError>([&] { const Bindings bindings(device, program, resources); });
    };
    const std::string missing = bindingError({{"from", &buffer}});
    EXPECT_TRUE(contains(missing, "'step'") && contains(missing, "'to'")) << missing;
    const std::string wrong = bindingError({{"from", &buffer}, {"to", &image}});
    EXPECT_TRUE(contains(wrong, "'to'") && contains(wrong, "a buffer")) << wrong;

    const std::vector<BoundResource> resources = {{"from", &buffer}, {"to", &buffer}};
    const Bindings bindings(device, program, resources);
    Commands commands(device);
    commands.begin();
    const std::string size = textOf<DeviceError>([&] {
        commands.dispatch("wrong pushes", {program, bindings}, std::uint64_t{0}, {1});
    });
    EXPECT_TRUE(contains(size, "4 bytes") && contains(size, "8 were")) << size;
    EXPECT_TRUE(contains(
        textOf<DeviceError>([&] {
            commands.pass("two layouts", {{&image, Access::compute_sample}, {&image, Access::compute_write}},
                          [](VkCommandBuffer) {});
        }),
        "'picture'"));
    commands.submit();
    commands.wait();
}

struct StepPush {
    std::uint32_t count;
};

/// Runs `steps` steps between two buffers, spread over `recordings` command buffers in flight together.
std::vector<std::uint32_t> ping(std::uint32_t steps, std::size_t recordings) {
    Device& device = testDevice();
    constexpr std::uint32_t kCount = 4096;
    const Program program = Program::compute(device, "step", gpu_step_comp, {});
    const Buffer a = upload("a", std::vector<std::uint32_t>(kCount, 1));
    const Buffer b(device, "b", kCount * 4, kStorage, Memory::device);
    const std::vector<BoundResource> forth = {{"from", &a}, {"to", &b}};
    const std::vector<BoundResource> back = {{"from", &b}, {"to", &a}};
    const Bindings bindings[2] = {Bindings(device, program, forth), Bindings(device, program, back)};
    std::vector<std::unique_ptr<Commands>> commands;
    for (std::size_t i = 0; i < recordings; ++i) {
        commands.push_back(std::make_unique<Commands>(device));
        commands.back()->begin();
        for (std::uint32_t step = 0; step < steps; ++step) {
            commands.back()->dispatch("step", {program, bindings[step % 2]}, StepPush{kCount}, {kCount});
        }
        commands.back()->submit();
    }
    for (const auto& one : commands) {
        one->wait();
        EXPECT_TRUE(one->done());
        EXPECT_EQ(one->times().at("step").count, steps);
    }
    return as<std::uint32_t>(readBuffer(device, a));
}

TEST(Commands, chainedPassesWaitForEachOther) {
    std::uint32_t expected = 1;
    for (int step = 0; step < 3 * 20; ++step) {
        expected = 3U * expected + 1U;
    }
    for (const std::uint32_t value : ping(20, 3)) {
        ASSERT_EQ(value, expected);
    }
}

/// A device of its own, whose validation messages do not fail the test.
struct WatchedDevice {
    WatchedDevice() : device(options(messages)) {}
    static DeviceOptions options(std::vector<std::string>& messages) {
        DeviceOptions options;
        options.device = std::to_string(testDevice().report().index);
        options.validation = true;
        options.on_validation_message = [&](const std::string& message) { messages.push_back(message); };
        return options;
    }
    std::vector<std::string> messages;
    Device device;
};

/// Steps there and back between two buffers, and what validation says to that.
template <typename Record>
std::vector<std::string> messagesOfSteps(const Record& record) {
    WatchedDevice watched;
    Device& device = watched.device;
    const Program program = Program::compute(device, "step", gpu_step_comp, {});
    const std::vector<std::uint32_t> ones(64, 1);
    const Buffer a = uploadBuffer(device, "a", std::span<const std::uint32_t>(ones), kStorage);
    const Buffer b(device, "b", 256, kStorage, Memory::device);
    const std::vector<BoundResource> forth = {{"from", &a}, {"to", &b}};
    const std::vector<BoundResource> back = {{"from", &b}, {"to", &a}};
    const Bindings there(device, program, forth);
    const Bindings home(device, program, back);
    EXPECT_EQ(watched.messages, std::vector<std::string>{});
    Commands commands(device);
    commands.begin();
    record(commands, program, there);
    record(commands, program, home);
    commands.submit();
    commands.wait();
    EXPECT_EQ(device.validationMessages(), watched.messages);
    return watched.messages;
}

TEST(Commands, usesFollowFromTheShaders) {
    const auto messages =
        messagesOfSteps([](Commands& commands, const Program& program, const Bindings& bindings) {
            commands.dispatch("step", {program, bindings}, StepPush{64}, {64});
        });
    EXPECT_EQ(messages, std::vector<std::string>{});
}

TEST(Commands, aMissingUseIsCaughtByValidation) {
    const auto messages =
        messagesOfSteps([](Commands& commands, const Program& program, const Bindings& bindings) {
            commands.pass("no uses", {}, [&](VkCommandBuffer recording) {
                const VkDescriptorSet set = bindings.set();
                const StepPush push{64};
                vkCmdBindPipeline(recording, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline());
                vkCmdBindDescriptorSets(recording, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout(), 0, 1,
                                        &set, 0, nullptr);
                vkCmdPushConstants(recording, program.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push),
                                   &push);
                vkCmdDispatch(recording, 1, 1, 1);
            });
        });
    ASSERT_FALSE(messages.empty());
    EXPECT_TRUE(contains(messages[0], "SYNC-HAZARD")) << messages[0];
}

/// Runs a texel program over one buffer, back on itself: a texel view stands for its buffer, wherever that
/// has moved.
TEST(Commands, texelViewsStandForTheirBuffer) {
    Device& device = testDevice();
    constexpr std::uint32_t kCount = 256;
    const Program program = Program::compute(device, "texels", gpu_texels_comp, {});
    Buffer made = upload("values", std::vector<std::uint32_t>(kCount, 1),
                         kStorage | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    const TexelView view(device, made, VK_FORMAT_R32_UINT);
    const std::vector<BoundResource> resources = {{"texels", &view}, {"to", &made}};
    const Bindings bindings(device, program, resources);
    const Buffer values = std::move(made);
    EXPECT_EQ(&view.tracked(), &values.tracked());
    Commands commands(device);
    commands.begin();
    for (int i = 0; i < 8; ++i) {
        commands.dispatch("texels", {program, bindings}, StepPush{kCount}, {kCount});
    }
    commands.submit();
    commands.wait();
    EXPECT_EQ(as<std::uint32_t>(readBuffer(device, values)), std::vector<std::uint32_t>(kCount, 511));
}

TEST(Commands, indirectDispatchesWaitForTheirArguments) {
    Device& device = testDevice();
    const Program program = Program::compute(device, "step", gpu_step_comp, {});
    const Buffer zeros = upload("zeros", std::vector<std::uint32_t>(64, 0));
    const Buffer arguments(device, "arguments", 256, kStorage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                           Memory::device);
    const Buffer result = upload("result", std::vector<std::uint32_t>(64, 0));
    const std::vector<BoundResource> count = {{"from", &zeros}, {"to", &arguments}};
    const std::vector<BoundResource> use = {{"from", &zeros}, {"to", &result}};
    const Bindings counting(device, program, count);
    const Bindings using_them(device, program, use);
    Commands commands(device);
    commands.begin();
    commands.dispatch("count", {program, counting}, StepPush{64}, {64});  // 1, 1, 1
    commands.dispatchIndirect("use", {program, using_them}, StepPush{64}, arguments, 0);
    commands.submit();
    commands.wait();
    EXPECT_EQ(as<std::uint32_t>(readBuffer(device, result)), std::vector<std::uint32_t>(64, 1));
}

TEST(Commands, timersMeasureTheDevice) {
    Device& device = testDevice();
    if (device.timestampBits() == 0) {
        Commands commands(device);
        commands.begin();
        commands.pass("nothing", {}, [](VkCommandBuffer) {});
        commands.submit();
        commands.wait();
        EXPECT_TRUE(commands.times().empty());
        return;
    }
    const Buffer large(device, "large", VkDeviceSize{1} << 26U, kStorage, Memory::device);
    Commands commands(device);
    const auto start = std::chrono::steady_clock::now();
    for (int frame = 0; frame < 2; ++frame) {
        commands.begin();
        commands.pass("small", {{&large, Access::transfer_write}}, [&](VkCommandBuffer recording) {
            vkCmdFillBuffer(recording, large.handle(), 0, 4, 1U);
        });
        commands.pass("large", {{&large, Access::transfer_write}}, [&](VkCommandBuffer recording) {
            vkCmdFillBuffer(recording, large.handle(), 0, VK_WHOLE_SIZE, 2U);
        });
        commands.submit();
        commands.wait(60.0);
    }
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const PassTime small_time = commands.times().at("small");
    const PassTime large_time = commands.times().at("large");
    EXPECT_EQ(large_time.count, 2U);
    EXPECT_GT(large_time.seconds, small_time.seconds) << "64 MiB against 4 bytes";
    EXPECT_LT(large_time.seconds + small_time.seconds, wall);
    RecordProperty("large_seconds", std::to_string(large_time.seconds));
}

/// Gives a device up while it works; what is destroyed afterwards waits for nothing. Ends the program.
[[noreturn]] void giveUpAndLeave() {
    std::optional<Device> device(std::in_place, DeviceOptions{});
    double seconds = 0.0;
    std::string said;
    {
        constexpr std::uint32_t kCount = 65535U * 64;
        const Program program = Program::compute(*device, "step", gpu_step_comp, {});
        const Buffer a(*device, "a", kCount * 4, kStorage, Memory::device);
        const Buffer b(*device, "b", kCount * 4, kStorage, Memory::device);
        const std::vector<BoundResource> resources = {{"from", &a}, {"to", &b}};
        const Bindings bindings(*device, program, resources);
        Commands commands(*device);
        commands.begin();
        for (std::uint32_t step = 0; step < 64; ++step)
            commands.dispatch("step", {program, bindings}, StepPush{kCount}, {kCount});
        commands.submit();
        said = textOf<HungDeviceError>([&] { commands.wait(0.0); });
        const auto start = std::chrono::steady_clock::now();
        said += textOf<HungDeviceError>([&] { commands.wait(); });
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    const bool given_up = device->givenUp();
    device.reset();
    const bool right = given_up && seconds < 1e-3 && contains(said, "within 0 seconds") &&
                       contains(said, "within 600 seconds");
    std::_Exit(right ? 0 : 3);
}

TEST(Commands, aDeviceThatDoesNotAnswerIsGivenUp) {
    EXPECT_EXIT(giveUpAndLeave(), testing::ExitedWithCode(0), "");
}

TEST(Commands, tooManyPassesAreRefused) {
    Commands commands(testDevice());
    commands.begin();
    for (std::uint32_t i = 0; i < Commands::kMaxPasses; ++i) {
        commands.pass("empty", {}, [](VkCommandBuffer) {});
    }
    EXPECT_THROW(commands.pass("one more", {}, [](VkCommandBuffer) {}), DeviceError);
    commands.submit();
    commands.wait();
}

constexpr std::uint32_t kSide = 16;

/// Draws triangles and returns the number of the one each pixel shows, 0 for none.
std::vector<std::uint32_t> draw(const std::vector<float>& positions, VkCullModeFlags cull) {
    Device& device = testDevice();
    const Program program = Program::raster(device, "triangle", gpu_triangle_vert, gpu_triangle_frag,
                                            {{VK_FORMAT_R32_UINT}, VK_FORMAT_D32_SFLOAT}, {});
    const Program sample = Program::compute(device, "sample", gpu_sample_comp, {});
    const Buffer source = upload("source", positions);
    const Buffer vertices(device, "vertices", source.size(), kStorage, Memory::device);
    const Image color(
        device, "color", {kSide, kSide}, VK_FORMAT_R32_UINT,
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const Image depth(device, "depth", {kSide, kSide}, VK_FORMAT_D32_SFLOAT,
                      VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    const Buffer result(device, "result", kSide * kSide * 4, kStorage, Memory::device);
    const Sampler sampler(device, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                          VK_SAMPLER_ADDRESS_MODE_REPEAT);
    const std::vector<BoundResource> resources = {
        {"vertices", &vertices}, {"picture", SampledImage{&color, &sampler}}, {"result", &result}};
    const Bindings bindings(device, program, resources);
    const Bindings sample_bindings(device, sample, resources);
    Commands commands(device);
    // Twice, so that every resource also goes back to its first use.
    for (int frame = 0; frame < 2; ++frame) {
        commands.begin();
        commands.pass("copy", {{&source, Access::transfer_read}, {&vertices, Access::transfer_write}},
                      [&](VkCommandBuffer recording) {
                          const VkBufferCopy copy{0, 0, source.size()};
                          vkCmdCopyBuffer(recording, source.handle(), vertices.handle(), 1, &copy);
                      });
        // A second kind of reader after this one must be made to see the copy too.
        commands.pass("look", {{&vertices, Access::compute_read}}, [](VkCommandBuffer) {});
        const ColorTarget target{&color};
        commands.draw("draw", {program, bindings}, {std::span(&target, 1), &depth},
                      [&](VkCommandBuffer recording) {
                          vkCmdSetCullMode(recording, cull);
                          vkCmdDraw(recording, static_cast<std::uint32_t>(positions.size() / 4), 1, 0, 0);
                      });
        const std::array size = {kSide, kSide};
        commands.dispatch("sample", {sample, sample_bindings}, size, {kSide, kSide});
        commands.submit();
        commands.wait();
    }
    const auto sampled = as<std::uint32_t>(readBuffer(device, result));
    EXPECT_EQ(sampled, as<std::uint32_t>(readImage(device, color)));
    return sampled;
}

TEST(Raster, aTriangleCoversItsPixelCentres) {
    // Corners in pixels, y down: (0, 16), (16.25, 16), (0, -0.25), counter-clockwise as one sees it. Inside
    // is y > x - 0.25, and no pixel centre lies on the slanted edge.
    constexpr float kQuarter = 2.0F * 0.25F / static_cast<float>(kSide);
    const std::vector<float> positions = {
        -1.0F, 1.0F, 0.5F, 1.0F, 1.0F + kQuarter, 1.0F, 0.5F, 1.0F, -1.0F, -1.0F - kQuarter, 0.5F, 1.0F};
    for (const VkCullModeFlags cull : {VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT}) {
        const std::vector<std::uint32_t> picture = draw(positions, cull);
        for (std::uint32_t y = 0; y < kSide; ++y) {
            for (std::uint32_t x = 0; x < kSide; ++x) {
                ASSERT_EQ(picture[y * kSide + x], y >= x ? 1U : 0U) << x << " " << y;
            }
        }
    }
    EXPECT_EQ(draw(positions, VK_CULL_MODE_FRONT_BIT), std::vector<std::uint32_t>(kSide * kSide, 0));
}

TEST(Raster, whatItCouldWriteUnorderedIsRefused) {
    Device& device = testDevice();
    const Program program = Program::raster(device, "writes", gpu_triangle_vert, gpu_writes_frag,
                                            {{VK_FORMAT_R32_UINT}, VK_FORMAT_UNDEFINED}, {});
    const Buffer buffer = upload("buffer", std::vector<std::uint32_t>(16));
    const std::vector<BoundResource> resources = {{"vertices", &buffer}, {"seen", &buffer}};
    const std::string text =
        textOf<DeviceError>([&] { const Bindings bindings(device, program, resources); });
    EXPECT_TRUE(contains(text, "'writes'") && contains(text, "'seen'")) << text;
    // Newer validation layers say the same of the program.
    for (const std::string& message : takeMessages()) {
        EXPECT_TRUE(contains(message, "VUID-RuntimeSpirv-NonWritable-06340")) << message;
    }
}

TEST(Raster, theGreaterDepthIsNearer) {
    const auto cover = [](float z) { return std::vector<float>{-1, -1, z, 1, -1, 3, z, 1, 3, -1, z, 1}; };
    for (const bool near_first : {true, false}) {
        std::vector<float> positions = cover(near_first ? 0.75F : 0.25F);
        const std::vector<float> second = cover(near_first ? 0.25F : 0.75F);
        positions.insert(positions.end(), second.begin(), second.end());
        EXPECT_EQ(draw(positions, VK_CULL_MODE_NONE),
                  std::vector<std::uint32_t>(kSide * kSide, near_first ? 1U : 2U));
    }
}

TEST(Devices, exactlyOneIsChosen) {
    const std::vector<DeviceReport> devices = listDevices({});
    int chosen = 0;
    for (const DeviceReport& device : devices) {
        EXPECT_FALSE(device.name.empty() || device.driver.empty() || device.api_version.empty() ||
                     device.type.empty());
        chosen += device.chosen ? 1 : 0;
        EXPECT_FALSE(device.chosen && !device.refusals.empty());
    }
    EXPECT_EQ(chosen, 1);
    DeviceOptions options;
    options.device = testDevice().report().name;
    EXPECT_TRUE(listDevices(options).at(testDevice().report().index).chosen);
    options.device = std::to_string(testDevice().report().index);
    EXPECT_TRUE(listDevices(options).at(testDevice().report().index).chosen);
}

TEST(Devices, aWrongNameSaysWhatThereIs) {
    DeviceOptions options;
    options.device = "Voodoo 2";
    const std::string text = textOf<InputError>([&] { const Device device(options); });
    EXPECT_TRUE(contains(text, "'Voodoo 2'") && contains(text, testDevice().report().name)) << text;
    for (const DeviceReport& device : listDevices(options)) {
        EXPECT_FALSE(device.chosen);
    }
}

TEST(Devices, everyReasonIsNamed) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(testDevice().physicalDevice(), &properties);
    VkPhysicalDeviceVulkan13Features features = neededFeatures();
    EXPECT_TRUE(refusals(properties, features).empty());
    properties.apiVersion = VK_API_VERSION_1_2;
    properties.limits.maxPerStageDescriptorStorageBuffers = 8;
    properties.limits.maxStorageBufferRange = (1U << 27U) - 1;
    features.dynamicRendering = VK_FALSE;
    const std::vector<std::string> expected = {"Vulkan 1.2.0, 1.3.0 needed", "no dynamicRendering",
                                               "maxPerStageDescriptorStorageBuffers is 8, 24 needed",
                                               "maxStorageBufferRange is 134217727, 134217728 needed"};
    EXPECT_EQ(refusals(properties, features), expected);
}

TEST(Devices, theFastestKindWinsAndNamesNeedNotBeWhole) {
    const auto candidate = [](std::uint32_t index, const char* name, VkPhysicalDeviceType type,
                              bool refused) {
        Candidate one;
        one.type = type;
        one.report.index = index;
        one.report.name = name;
        if (refused) {
            one.report.refusals.emplace_back("too old");
        }
        return one;
    };
    const std::vector<Candidate> candidates = {
        candidate(0, "llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU, false),
        candidate(1, "Small GPU", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, false),
        candidate(2, "Large GPU", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, false),
        candidate(3, "Old GPU", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, true),
    };
    EXPECT_EQ(chooseDevice(candidates, ""), 2U);
    EXPECT_EQ(chooseDevice(candidates, "LLVM"), 0U);
    EXPECT_EQ(chooseDevice(candidates, "1"), 1U);
    EXPECT_EQ(chooseDevice(candidates, "gpu"), 2U);
    EXPECT_EQ(chooseDevice(candidates, "old"), std::nullopt);
    EXPECT_EQ(chooseDevice(candidates, "3"), std::nullopt);
    EXPECT_EQ(chooseDevice(std::span(candidates).first(2), ""), 1U);
    EXPECT_TRUE(contains(describeDevices(candidates), "3 'Old GPU' (refused: too old)"));
}

}  // namespace
}  // namespace licht::gpu
