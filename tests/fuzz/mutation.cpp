#include "mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

namespace licht::fuzz {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t end) {
    return end == 0 ? 0 : random() % end;
}

void flipBit(std::string& bytes, Random& random) {
    if (bytes.empty()) return;
    char& byte = bytes[below(random, bytes.size())];
    byte = static_cast<char>(byte ^ (1 << below(random, 8)));
}

void setByte(std::string& bytes, Random& random) {
    if (!bytes.empty()) bytes[below(random, bytes.size())] = static_cast<char>(random());
}

/// Numbers at which sizes, offsets and signs turn over; in either order of bytes.
void setWord(std::string& bytes, Random& random) {
    constexpr std::array<std::uint32_t, 12> kWords{0,          1,          0x7f,       0xff,
                                                   0xffff,     0x10000,    0x8000,     0x7fffffff,
                                                   0x80000000, 0xffffffff, 0x7f800000, 0x3fffffff};
    if (bytes.size() < 4) return;
    const std::uint32_t word = kWords.at(below(random, kWords.size()));
    const std::size_t at = below(random, bytes.size() - 3);
    const bool big_endian = random() % 2 == 0;
    for (std::size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<char>(word >> 8U * (big_endian ? 3 - i : i));
}

/// A number in a text becomes another.
void setNumber(std::string& bytes, Random& random) {
    constexpr std::array<const char*, 14> kNumbers{
        "0",          "-1",         "1",     "255",   "65536",
        "2147483647", "4294967295", "1e38",  "1e308", "18446744073709551615",
        "-1e308",     "0.5",        "1e-45", "16"};
    const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(below(random, bytes.size()));
    const auto first = std::find_if(from, bytes.end(), isDigit);
    const auto last = std::find_if_not(first, bytes.end(), isDigit);
    const char* number = kNumbers.at(below(random, kNumbers.size()));
    if (first != last) bytes.replace(first, last, number);
}

void takeOut(std::string& bytes, Random& random) {
    const std::size_t at = below(random, bytes.size());
    bytes.erase(at, 1 + below(random, std::min<std::size_t>(bytes.size(), 64)));
}

void copyWithin(std::string& bytes, Random& random) {
    const std::string part = bytes.substr(below(random, bytes.size()), 1 + below(random, 64));
    bytes.insert(below(random, bytes.size() + 1), part);
}

void cut(std::string& bytes, Random& random) {
    bytes.resize(below(random, bytes.size() + 1));
}

}  // namespace

std::string damaged(std::span<const std::string> seeds, std::mt19937_64& random) {
    std::string bytes = seeds[below(random, seeds.size())];
    const std::size_t steps = 1 + below(random, 8);
    for (std::size_t i = 0; i < steps; ++i) {
        switch (random() % 16) {
            case 0:
                cut(bytes, random);
                break;
            case 1:
                takeOut(bytes, random);
                break;
            case 2:
                copyWithin(bytes, random);
                break;
            case 3: {
                const std::string& other = seeds[below(random, seeds.size())];
                const std::size_t at = below(random, std::min(bytes.size(), other.size()));
                bytes = bytes.substr(0, at) + other.substr(at);
                break;
            }
            case 4:
            case 5:
            case 6:
                setWord(bytes, random);
                break;
            case 7:
            case 8:
            case 9:
            case 10:
                setNumber(bytes, random);
                break;
            case 11:
            case 12:
                setByte(bytes, random);
                break;
            default:
                flipBit(bytes, random);
        }
    }
    return bytes;
}

}  // namespace licht::fuzz
