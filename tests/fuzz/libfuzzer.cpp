// Under libFuzzer: build with clang and LICHT_SANITIZE, then run libfuzzer_NAME [FOLDER_OF_INPUTS].
#include <cstddef>
#include <cstdint>
#include <random>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    licht::fuzz::readInput({reinterpret_cast<const char*>(bytes), size});
    return 0;
}
