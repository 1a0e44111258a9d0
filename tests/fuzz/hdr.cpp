// A sky in Radiance's format.
#include "fuzz.h"
#include "licht/core/error.h"
#include "licht/core/memory.h"
#include "licht/image/files.h"

namespace licht::fuzz {

bool readInput(std::string_view bytes) {
    limitMemory(std::uint64_t{1} << 30U);
    try {
        readRadianceMap(asFile("a.hdr", bytes));
    } catch (const InputError&) {
        return false;
    }
    return true;
}

std::vector<std::string> seeds() {
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\nCOLORCORR=1 2 3\n";
    std::string flat = head + "\n-Y 2 +X 3\n";
    for (int i = 0; i < 24; ++i) flat += static_cast<char>(100 + i);
    // A row of eight texels, packed: runs and single bytes of each channel.
    std::string packed = head + "PRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329\n\n-Y 2 +X 8\n";
    for (int row = 0; row < 2; ++row) {
        packed += std::string("\x02\x02\x00\x08", 4);
        for (int channel = 0; channel < 4; ++channel) packed += std::string("\x85\x7f\x03\x10\x20\x30", 6);
    }
    return {flat, packed};
}

}  // namespace licht::fuzz
