#pragma once
#include <cstddef>

namespace licht {

/// Memory of a decoder in C, which gives nothing back where an error is thrown through it. As calloc, realloc
/// and free, each thread for itself: stb_image 2.27 decodes by tables that a file does not define, and those
/// shall be zero and not what lay there before.
void* takeDecoderMemory(std::size_t size);
void* resizeDecoderMemory(void* block, std::size_t size);
void giveDecoderMemory(void* block);
/// All that this thread has taken and not given back.
void giveAllDecoderMemory();

}  // namespace licht
