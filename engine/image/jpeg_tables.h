#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace licht {

/// Throws InputError where a JPEG has a table of more codes than a byte can name: stb_image 2.27 writes them
/// beyond its own. Whatever else is wrong is left to the decoder.
void requireSoundJpegTables(std::span<const std::byte> bytes, const std::string& name);

}  // namespace licht
