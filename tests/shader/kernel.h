#pragma once
// Runs a compute shader over buffers and hands back what it wrote.
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "licht/gpu/commands.h"
#include "support/gpu_test.h"

namespace licht::test {

/// A kernel that reads the buffer "Questions" and writes the buffer "Answers".
class Kernel {
public:
    Kernel(std::string name, gpu::Spirv spirv, const gpu::SpecConstants& constants = {})
        : program_(gpu::Program::compute(gpu::testDevice(), std::move(name), spirv, constants)) {}

    /// `threads` threads write `answers` values in all. `others` are bound beside the two buffers.
    template <typename Answer, typename Push, typename Question>
    std::vector<Answer> run(std::uint32_t threads, std::size_t answers, const Push& push,
                            const std::vector<Question>& questions,
                            std::vector<gpu::BoundResource> others = {}) {
        gpu::Device& device = gpu::testDevice();
        const gpu::Buffer input = gpu::uploadBuffer(device, "Questions", std::span<const Question>(questions),
                                                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        const gpu::Buffer output(device, "Answers", answers * sizeof(Answer),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                 gpu::Memory::device);
        others.push_back({"Questions", &input});
        others.push_back({"Answers", &output});
        const gpu::Bindings bindings(device, program_, others);
        gpu::Commands commands(device);
        commands.begin();
        commands.dispatch(program_.name(), {program_, bindings}, push, {threads});
        commands.submit();
        commands.wait();
        const std::vector<std::byte> bytes = gpu::readBuffer(device, output);
        std::vector<Answer> values(answers);
        std::memcpy(values.data(), bytes.data(), answers * sizeof(Answer));
        return values;
    }

private:
    gpu::Program program_;
};

}  // namespace licht::test
