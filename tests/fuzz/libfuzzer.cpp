// Under libFuzzer: build with clang and LICHT_SANITIZE, then run libfuzzer_NAME [FOLDER_OF_INPUTS]. The good
// inputs are put into the folder, so that it does not have to find out what one looks like.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz.h"

extern "C" int LLVMFuzzerInitialize(int* argument_count, char*** arguments) {
    for (int i = 1; i < *argument_count; ++i) {
        const std::filesystem::path folder = (*arguments)[i];
        if (!std::filesystem::is_directory(folder)) continue;
        int number = 0;
        for (const std::string& seed : licht::fuzz::seeds())
            std::ofstream(folder / ("good" + std::to_string(number++)), std::ios::binary) << seed;
        break;
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    licht::fuzz::readInput({reinterpret_cast<const char*>(bytes), size});
    return 0;
}
