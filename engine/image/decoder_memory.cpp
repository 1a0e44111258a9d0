#include "licht/image/decoder_memory.h"

#include <cstdlib>
#include <memory>
#include <unordered_set>
#include <utility>

namespace licht {
namespace {

thread_local std::unordered_set<void*> t_taken;

struct Freed {
    void operator()(void* block) const { std::free(block); }
};

}  // namespace

void* takeDecoderMemory(std::size_t size) {
    std::unique_ptr<void, Freed> block(std::calloc(1, size));
    if (block) t_taken.insert(block.get());
    return block.release();
}

void* resizeDecoderMemory(void* block, std::size_t size) {
    // Its place is kept, so that what has moved can be noted without memory.
    auto place = t_taken.extract(block);
    if (place.empty()) return takeDecoderMemory(size);
    void* moved = std::realloc(block, size);
    place.value() = moved != nullptr ? moved : block;
    t_taken.insert(std::move(place));
    return moved;
}

void giveDecoderMemory(void* block) {
    t_taken.erase(block);
    std::free(block);
}

void giveAllDecoderMemory() {
    for (void* block : t_taken) std::free(block);
    t_taken.clear();
}

}  // namespace licht
