// Are two .exr files the same picture, bit for bit, channel by channel? What is written beside the picture
// may differ.
#include <cstdio>
#include <cstring>
#include <exception>

#include "licht/image/exr.h"

int main(int argument_count, char** arguments) try {
    if (argument_count != 3) {
        std::fprintf(stderr, "same_bits A.exr B.exr\n");
        return 2;
    }
    const licht::ExrPicture a = licht::readExr(arguments[1]);
    const licht::ExrPicture b = licht::readExr(arguments[2]);
    if (a.width != b.width || a.height != b.height || a.channels.size() != b.channels.size()) {
        std::printf("of another size, or with other channels\n");
        return 1;
    }
    for (const licht::ExrChannel& channel : a.channels) {
        const licht::ExrChannel* other = b.find(channel.name);
        if (other == nullptr) {
            std::printf("no channel %s\n", channel.name.c_str());
            return 1;
        }
        std::size_t different = 0;
        std::size_t first = 0;
        for (std::size_t i = 0; i < channel.values.size(); ++i)
            if (std::memcmp(&channel.values[i], &other->values[i], sizeof(float)) != 0 && different++ == 0)
                first = i;
        if (different > 0) {
            std::printf("channel %s: %zu of %zu values differ, first (%zu, %zu): %.9g and %.9g\n",
                        channel.name.c_str(), different, channel.values.size(),
                        first % static_cast<std::size_t>(a.width), first / static_cast<std::size_t>(a.width),
                        static_cast<double>(channel.values[first]),
                        static_cast<double>(other->values[first]));
            return 1;
        }
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "same_bits: %s\n", error.what());
    return 2;
}
