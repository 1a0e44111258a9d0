#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/image/exr.h"
#include "licht/image/files.h"

namespace licht {
namespace {

namespace fs = std::filesystem;

class ImageTest : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "licht-image-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path folder_;
};
using ExrTest = ImageTest;
using PngTest = ImageTest;
using HdrTest = ImageTest;

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::string get(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    std::string text(bytes.size(), '\0');
    std::memcpy(text.data(), bytes.data(), bytes.size());
    return text;
}

/// Runs `call`, which must throw InputError, and checks that its text names both.
template <typename Call>
void expectInputError(Call call, const std::string& name, const std::string& reason) {
    try {
        call();
        ADD_FAILURE() << "no InputError for " << name << " (" << reason << ")";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find(name), std::string::npos) << text;
        EXPECT_NE(text.find(reason), std::string::npos) << text;
    }
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// 300 lines: many steps of the reader, the last one short. Values over the whole range of floats.
ExrPicture layeredPicture() {
    ExrPicture picture;
    picture.width = 37;
    picture.height = 300;
    for (const char* name : {"R", "G", "B", "A", "albedo.R", "N.X", "Z", "sampleCount"}) {
        ExrChannel channel{name, {}};
        for (int i = 0; i < picture.width * picture.height; ++i)
            channel.values.push_back(std::ldexp(1.0F + 0.001F * static_cast<float>(i % 997), i % 250 - 125) *
                                     (i % 3 == 0 ? -1.0F : 1.0F));
        channel.values[0] = 1e6F;
        channel.values[1] = std::numeric_limits<float>::denorm_min();
        channel.values[2] = 1e-40F;
        channel.values[3] = std::numeric_limits<float>::max();
        channel.values[4] = std::numeric_limits<float>::infinity();
        channel.values[5] = -0.0F;
        channel.values[6] = static_cast<float>(picture.channels.size());
        picture.channels.push_back(std::move(channel));
    }
    picture.attributes = {
        {"licht.scene", "cornell"}, {"licht.seed", "17"}, {"aLongerNameThanThirtyOneLettersHere", "x"}};
    return picture;
}

TEST_F(ExrTest, RoundTripIsExactToTheBit) {
    const ExrPicture picture = layeredPicture();
    writeExr(folder_ / "a.exr", picture);
    const ExrPicture read = readExr(folder_ / "a.exr");
    EXPECT_EQ(read.width, picture.width);
    EXPECT_EQ(read.height, picture.height);
    EXPECT_EQ(read.channels.size(), picture.channels.size());
    for (const ExrChannel& channel : picture.channels) {
        const ExrChannel* same = read.find(channel.name);
        ASSERT_NE(same, nullptr) << channel.name;
        EXPECT_TRUE(sameBits(same->values, channel.values)) << channel.name;
    }
    EXPECT_EQ(read.find("Y"), nullptr);
    for (const auto& attribute : picture.attributes)
        EXPECT_EQ(std::ranges::count(read.attributes, attribute), 1) << attribute.first;
    const std::string bytes = get(folder_ / "a.exr");
    EXPECT_NE(bytes.find("chromaticities"), std::string::npos);
}

TEST_F(ExrTest, WriteReplacesTheOldFileOnlyWhenComplete) {
    put(folder_ / "a.exr", "old");
    ExrPicture picture = layeredPicture();
    // No place for an attribute that has the name of a required one of another type.
    picture.attributes.emplace_back("compression", "none");
    EXPECT_THROW(writeExr(folder_ / "a.exr", picture), DeviceError);
    EXPECT_EQ(get(folder_ / "a.exr"), "old");
    expectInputError([&] { writeExr(folder_ / "missing" / "a.exr", layeredPicture()); }, "a.exr",
                     "folder does not exist");
}

TEST_F(ExrTest, EveryTruncationIsRefused) {
    writeExr(folder_ / "a.exr", layeredPicture());
    const std::string whole = get(folder_ / "a.exr");
    const fs::path path = folder_ / "short.exr";
    // Through header, offset table and data, and the last byte.
    std::vector<std::size_t> lengths = {0, 3, 4, 8, 9, whole.size() - 1};
    for (std::size_t length = 16; length < whole.size(); length += length < 2000 ? 97 : whole.size() / 13)
        lengths.push_back(length);
    for (const std::size_t length : lengths) {
        put(path, whole.substr(0, length));
        expectInputError([&] { readExr(path); }, "short.exr", "");
    }
}

TEST_F(ExrTest, DamagedDataIsRefused) {
    writeExr(folder_ / "a.exr", layeredPicture());
    std::string bytes = get(folder_ / "a.exr");
    for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 64; ++i) bytes[i] = '\x55';
    put(folder_ / "damaged.exr", bytes);
    expectInputError([&] { readExr(folder_ / "damaged.exr"); }, "damaged.exr", "");
}

TEST_F(ExrTest, RefusesWhatIsNoExr) {
    put(folder_ / "text.exr", "this is text");
    expectInputError([&] { readExr(folder_ / "text.exr"); }, "text.exr", "no OpenEXR file");
    expectInputError([&] { readExr(folder_ / "missing.exr"); }, "missing.exr", "no such file");
    expectInputError([&] { readExr(folder_); }, folder_.string(), "folder");
}

/// Overwrites the data and display windows in the header of a written file.
std::string withWindow(std::string bytes, std::int32_t min_x, std::int32_t min_y, std::int32_t max_x,
                       std::int32_t max_y) {
    const std::int32_t window[4] = {min_x, min_y, max_x, max_y};
    for (const std::string name : {"dataWindow", "displayWindow"}) {
        // Name, zero, "box2i", zero, four bytes of size, then the window.
        const std::size_t at = bytes.find(name) + name.size() + 1 + 6 + 4;
        std::memcpy(bytes.data() + at, window, sizeof(window));
    }
    return bytes;
}

TEST_F(ExrTest, HugeWindowsAreRefusedFast) {
    ExrPicture picture = layeredPicture();
    picture.channels.resize(1);
    writeExr(folder_ / "a.exr", picture);
    const std::string good = get(folder_ / "a.exr");
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    const fs::path path = folder_ / "huge.exr";
    const std::int32_t windows[][4] = {{0, 0, kMaxImageSide, 10},
                                       {0, 0, 10, kMaxImageSide},
                                       {0, 0, most, most},
                                       {-most - 1, -most - 1, most, most},
                                       {-most / 2, -most / 2, most / 2, most / 2},
                                       {5, 5, 4, 4}};
    for (const auto& w : windows) {
        put(path, withWindow(good, w[0], w[1], w[2], w[3]));
        expectInputError([&] { readExr(path); }, "huge.exr", "");
    }
    // Within the limit, 4 GiB a channel, and far more than the file holds.
    put(path, withWindow(good, 0, 0, kMaxImageSide - 1, kMaxImageSide - 1));
    expectInputError([&] { readExr(path); }, "huge.exr", "");
}

// The library would take the memory first.
TEST_F(ExrTest, AttributesBeyondTheFileAreRefused) {
    writeExr(folder_ / "a.exr", layeredPicture());
    const std::string good = get(folder_ / "a.exr");
    for (const std::string& start :
         {std::string("licht.scene\0string\0", 19), std::string("channels\0chlist\0", 16)}) {
        for (const std::uint32_t size :
             {static_cast<std::uint32_t>(good.size()), 0x64030000U, 0x80000000U, 0xffffffffU}) {
            std::string bytes = good;
            const std::size_t at = bytes.find(start) + start.size();
            for (unsigned i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(size >> 8U * i & 0xffU);
            put(folder_ / "long.exr", bytes);
            expectInputError([&] { readExr(folder_ / "long.exr"); }, "long.exr", "ends beyond the file");
        }
    }
}

TEST_F(ExrTest, WindowAwayFromTheOriginIsRead) {
    const ExrPicture picture = layeredPicture();
    writeExr(folder_ / "a.exr", picture);
    std::string bytes =
        withWindow(get(folder_ / "a.exr"), -1000, 2000, -1000 + picture.width - 1, 2000 + picture.height - 1);
    // Each chunk of 16 lines begins with its first line's number; the offset table ends where the first chunk
    // begins.
    const std::size_t chunks = static_cast<std::size_t>(picture.height + 15) / 16;
    std::size_t table = 0;
    for (std::size_t at = 8; table == 0 && at + 8 < bytes.size(); ++at) {
        std::uint64_t offset = 0;
        std::memcpy(&offset, bytes.data() + at, sizeof(offset));
        if (offset == at + chunks * sizeof(offset)) table = at;
    }
    ASSERT_NE(table, 0U);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        std::uint64_t offset = 0;
        std::memcpy(&offset, bytes.data() + table + chunk * sizeof(offset), sizeof(offset));
        const auto line = static_cast<std::int32_t>(2000 + 16 * chunk);
        std::memcpy(bytes.data() + offset, &line, sizeof(line));
    }
    put(folder_ / "moved.exr", bytes);
    const ExrPicture read = readExr(folder_ / "moved.exr");
    ASSERT_EQ(read.width, picture.width);
    ASSERT_EQ(read.height, picture.height);
    EXPECT_TRUE(sameBits(read.find("Z")->values, picture.find("Z")->values));
}

TEST_F(ExrTest, DeepMultiPartAndSubsampledAreRefused) {
    writeExr(folder_ / "a.exr", layeredPicture());
    const std::string good = get(folder_ / "a.exr");
    // Bits 11 and 12 of the version field: deep data and several parts.
    for (const auto& [bit, kind] : {std::pair{0x08, "deep"}, std::pair{0x10, "multi-part"}}) {
        std::string bytes = good;
        bytes[5] = static_cast<char>(bytes[5] | bit);
        put(folder_ / "other.exr", bytes);
        expectInputError([&] { readExr(folder_ / "other.exr"); }, "other.exr", kind);
    }
    // The channel "Z": name, zero, type, linear flag and padding, then the two samplings.
    std::string bytes = good;
    const std::size_t at = bytes.find(std::string("Z\0\2\0\0\0", 6));
    ASSERT_NE(at, std::string::npos);
    bytes[at + 2 + 8] = 37;
    put(folder_ / "other.exr", bytes);
    expectInputError([&] { readExr(folder_ / "other.exr"); }, "other.exr", "'Z' is subsampled");
}

TEST_F(PngTest, RoundTripOfAllCodesIsExact) {
    for (const int channels : {1, 3, 4}) {
        Image picture(64, 4, channels);
        for (std::size_t i = 0; i < picture.texels.size(); ++i)
            picture.texels[i] = static_cast<float>(i % 256) / 255.0F;
        writePng(folder_ / "a.png", picture);
        const EncodedImage read = decodeImage(readFile(folder_ / "a.png"), "a.png");
        ASSERT_EQ(read.width, 64);
        ASSERT_EQ(read.height, 4);
        ASSERT_EQ(read.bits, 8);
        ASSERT_EQ(read.bytes.size(), 64U * 4U * 4U);
        for (std::size_t texel = 0; texel < 64U * 4U; ++texel)
            for (std::size_t c = 0; c < 4; ++c) {
                const auto stored = static_cast<std::size_t>(channels);
                const std::size_t source = channels == 1 ? texel : texel * stored + c;
                const std::size_t expected = c == 3 && channels != 4 ? 255 : source % 256;
                ASSERT_EQ(read.bytes[texel * 4 + c], expected) << channels << " " << texel << " " << c;
            }
    }
}

TEST_F(PngTest, RoundsToTheNearestCodeAndClamps) {
    Image picture(8, 1, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    picture.texels = {nan,       -1.0F,          2.0F,           infinite,
                      -infinite, 0.49F / 255.0F, 0.51F / 255.0F, 254.49F / 255.0F};
    writePng(folder_ / "a.png", picture);
    const EncodedImage read = decodeImage(readFile(folder_ / "a.png"), "a.png");
    const int expected[] = {0, 0, 255, 255, 0, 0, 1, 254};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(read.bytes[4 * i], expected[i]) << i;
}

TEST_F(PngTest, UnwritablePlaceIsRefused) {
    expectInputError([&] { writePng(folder_, Image(1, 1, 3)); }, folder_.string(), "folder");
    expectInputError([&] { writePng(folder_ / "no" / "a.png", Image(1, 1, 3)); }, "a.png",
                     "folder does not exist");
}

std::string bigEndian(std::uint32_t value) {
    std::string text;
    for (const unsigned shift : {24U, 16U, 8U, 0U}) text += static_cast<char>(value >> shift & 0xffU);
    return text;
}

/// One PNG chunk with its CRC-32 (ISO 3309, as in the PNG specification, annex D).
std::string chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffU;
    for (const char letter : type + data) {
        crc ^= static_cast<unsigned char>(letter);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0U ? 0xedb88320U : 0U);
    }
    return bigEndian(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian(~crc);
}

/// A PNG with the given raw rows (filter bytes included) in one stored deflate block.
std::string png(std::uint32_t width, std::uint32_t height, char bits, char colour_type,
                const std::string& raw) {
    const std::string header =
        bigEndian(width) + bigEndian(height) + bits + colour_type + std::string(3, '\0');
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char letter : raw) {
        a = (a + static_cast<unsigned char>(letter)) % 65521U;
        b = (b + a) % 65521U;
    }
    const auto size = static_cast<std::uint16_t>(raw.size());
    std::string stream = "\x78\x01\x01";
    for (const unsigned word : {static_cast<unsigned>(size), ~static_cast<unsigned>(size)}) {
        stream += static_cast<char>(word & 0xffU);
        stream += static_cast<char>(word >> 8U & 0xffU);
    }
    stream += raw + bigEndian(b << 16U | a);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", stream) + chunk("IEND", "");
}

TEST(Decode, SixteenBitTexelsKeepAllBits) {
    // Two RGB texels, big-endian in the file.
    const std::string raw("\0\x12\x34\x56\x78\x9a\xbc\xde\xf0\x00\x01\xff\xfe", 13);
    const EncodedImage read = decodeImage(bytesOf(png(2, 1, 16, 2, raw)), "deep.png");
    EXPECT_EQ(read.bits, 16);
    ASSERT_EQ(read.bytes.size(), 16U);
    std::uint16_t texels[8];
    std::memcpy(texels, read.bytes.data(), sizeof(texels));
    const std::uint16_t expected[] = {0x1234, 0x5678, 0x9abc, 0xffff, 0xdef0, 0x0001, 0xfffe, 0xffff};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(texels[i], expected[i]) << i;
}

TEST(Decode, HugeHeadersAreRefused) {
    const std::string raw(4, '\0');
    expectInputError([&] { decodeImage(bytesOf(png(65535, 65535, 8, 2, raw)), "bomb.png"); }, "bomb.png",
                     "too large");
    for (const std::string& bomb : {png(32769, 1, 8, 2, raw), png(1, 32769, 8, 2, raw)})
        expectInputError([&] { decodeImage(bytesOf(bomb), "bomb.png"); }, "bomb.png", "size of");
    // Each side is allowed, their product is not.
    expectInputError([&] { decodeImage(bytesOf(png(32768, 10000, 8, 2, raw)), "bomb.png"); }, "bomb.png",
                     "2^28");
    // All is allowed, but the file does not hold it.
    expectInputError([&] { decodeImage(bytesOf(png(16384, 16384, 8, 2, raw)), "bomb.png"); }, "bomb.png", "");
}

TEST(Decode, TruncatedAndForeignBytesAreRefused) {
    const std::string whole = png(2, 2, 8, 2, std::string("\0\1\2\3\4\5\6\0\7\10\11\12\13\14", 14));
    EXPECT_EQ(decodeImage(bytesOf(whole), "whole.png").bytes[4], 4);
    // The decoder stops at the header of the closing chunk, whose CRC it does not read.
    for (std::size_t length = 0; length < whole.size() - 4; ++length)
        expectInputError([&] { decodeImage(bytesOf(whole.substr(0, length)), "short.png"); }, "short.png",
                         "");
    expectInputError([&] { decodeImage(bytesOf("GIF89a..........."), "a.gif"); }, "a.gif",
                     "neither PNG nor JPEG");
    expectInputError([&] { decodeImage({}, "none"); }, "none", "neither PNG nor JPEG");
}

/// An 8 x 2 JPEG. By default a constant grey 128: one code a table, "0", for a difference of zero (DC) and
/// for the end of a block (AC), so that every block's coefficients are zero.
std::string greyJpeg(const std::string& ac_counts = '\1' + std::string(15, '\0'),
                     const std::string& ac_symbols = std::string(1, '\0'),
                     const std::string& codes = "\x3f") {
    std::string text("\xff\xd8\xff\xdb\0\x43\0", 7);
    text += std::string(64, '\1');
    text += std::string("\xff\xc0\0\x0b\x08\0\x02\0\x08\1\1\x11\0", 13);
    const auto table = [&text](char id, const std::string& counts, const std::string& symbols) {
        const std::size_t length = 3 + counts.size() + symbols.size();
        text += std::string("\xff\xc4") + static_cast<char>(length >> 8U) + static_cast<char>(length & 0xffU);
        text += id + counts + symbols;
    };
    table('\x00', '\1' + std::string(15, '\0'), std::string(1, '\0'));
    table('\x10', ac_counts, ac_symbols);
    text += std::string("\xff\xda\0\x08\1\1\0\0\x3f\0", 10);
    return text + codes + "\xff\xd9";
}

TEST(Decode, JpegIsReadAndItsTruncationRefused) {
    const std::string whole = greyJpeg();
    const EncodedImage read = decodeImage(bytesOf(whole), "grey.jpg");
    EXPECT_EQ(read.width, 8);
    EXPECT_EQ(read.height, 2);
    EXPECT_EQ(read.bits, 8);
    ASSERT_EQ(read.bytes.size(), 64U);
    EXPECT_EQ(read.bytes[0], 128);
    EXPECT_EQ(read.bytes[3], 255);
    for (std::size_t length = 0; length < whole.size(); ++length)
        expectInputError([&] { decodeImage(bytesOf(whole.substr(0, length)), "short.jpg"); }, "short.jpg",
                         "");
}

// Counts of codes by length: 254 of 8 bits and two of 9. stb_image takes number 255 for "no short code", and
// finds that what it reads next is another code than the one it looked up.
TEST(Decode, CodesThatContradictEachOtherAreRefusedAndLeaveNoMemory) {
    const std::string counts = std::string(7, '\0') + '\xfe' + '\2' + std::string(7, '\0');
    const std::string text = greyJpeg(counts, std::string(256, '\1'), "\x7f\x40");
    const auto decode = [&] {
        expectInputError([&] { decodeImage(bytesOf(text), "codes.jpg"); }, "codes.jpg",
                         "contradict each other");
    };
    decode();
    const std::size_t before = mallinfo2().uordblks;
    for (int i = 0; i < 100; ++i) decode();
    EXPECT_LT(mallinfo2().uordblks, before + 18'000);  // of a single decoder
}

// More codes than a byte can name would be written beyond the decoder's tables, and those that the file's end
// cuts off, or that lie behind their own segment, are what the decoder makes of it.
TEST(Decode, TablesOfTooManyCodesAreRefused) {
    const std::string counts = std::string(8, '\0') + std::string(8, '\xff');
    const std::string text = greyJpeg(counts, std::string(8 * 255, '\0'));
    expectInputError([&] { decodeImage(bytesOf(text), "many.jpg"); }, "many.jpg", "a table of 2040 codes");
    const std::size_t at = text.rfind("\xff\xc4");
    std::string beyond = text;
    beyond[at + 2] = '\0';
    beyond[at + 3] = '\3';
    expectInputError([&] { decodeImage(bytesOf(beyond), "beyond.jpg"); }, "beyond.jpg",
                     "a table of 2040 codes");
    for (std::size_t more = 2; more < 21; ++more)
        expectInputError([&] { decodeImage(bytesOf(text.substr(0, at + more)), "cut.jpg"); }, "cut.jpg",
                         "truncated");
    // Behind the codes of a picture, too, and not where a comment only looks like it.
    const std::string whole = greyJpeg();
    const std::string table = text.substr(at, 4 + 1 + 16 + 8 * 255);
    const std::string behind = whole.substr(0, whole.size() - 2) + table + "\xff\xd9";
    expectInputError([&] { decodeImage(bytesOf(behind), "behind.jpg"); }, "behind.jpg",
                     "a table of 2040 codes");
    const std::string comment = std::string("\xff\xfe\0\x17", 4) + table.substr(0, 21);
    EXPECT_EQ(decodeImage(bytesOf(whole.substr(0, 2) + comment + whole.substr(2)), "said.jpg").bytes[0], 128);
}

// What a file leaves out is zero, not what lay in memory before: the same bytes, the same picture.
TEST(Decode, TablesThatAreNotThereAreZero) {
    std::string text = greyJpeg();
    const std::size_t first = text.find("\xff\xc4");
    text.erase(first, text.rfind("\xff\xda") - first);
    for (const int filled : {0, 0x5a, 0xff}) {
        mallopt(M_PERTURB, filled);
        EXPECT_EQ(decodeImage(bytesOf(text), "none.jpg").bytes[0], 128) << filled;
    }
    mallopt(M_PERTURB, 0);
}

/// A Radiance picture of 2 x 2 uncompressed texels (mantissas and a common exponent, biased by 128 + 8 bits).
std::string radiance() {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n";
    return header + std::string(
                        "\x80\x40\x20\x81"
                        "\x80\x80\x80\x95"
                        "\x01\x02\x03\x88"
                        "\0\0\0\0",
                        16);
}

TEST_F(HdrTest, RadianceIsRead) {
    put(folder_ / "a.HDR", radiance());
    std::size_t replaced = 99;
    const Image map = readRadianceMap(folder_ / "a.HDR", &replaced);
    EXPECT_EQ(replaced, 0U);
    ASSERT_EQ(map.width, 2);
    ASSERT_EQ(map.height, 2);
    ASSERT_EQ(map.channels, 3);
    // value = mantissa * 2^(exponent - 136)
    const std::vector<float> expected = {1.0F, 0.5F, 0.25F, 1048576.0F, 1048576.0F, 1048576.0F,
                                         1.0F, 2.0F, 3.0F,  0.0F,       0.0F,       0.0F};
    EXPECT_EQ(map.texels, expected);
}

/// The same texels under other header lines.
std::string radianceUnder(const std::string& lines, const std::string& resolution = "-Y 2 +X 2") {
    const std::string whole = radiance();
    const std::string format = lines.starts_with("FORMAT") ? "" : "FORMAT=32-bit_rle_rgbe\n";
    return "#?RADIANCE\n" + format + lines + "\n" + resolution + "\n" + whole.substr(whole.size() - 16);
}

// Radiance is what is stored over all EXPOSURE and COLORCORR, which multiply.
TEST_F(HdrTest, HeadersThatScaleAreObeyed) {
    const auto first = [&](const std::string& lines) {
        put(folder_ / "a.hdr", radianceUnder(lines));
        const Image map = readRadianceMap(folder_ / "a.hdr");
        return std::vector<float>(map.texels.begin(), map.texels.begin() + 3);
    };
    EXPECT_EQ(first("EXPOSURE=4\n# a remark = 3\nEXPOSURE= +0.5\r\n"),
              (std::vector<float>{0.5F, 0.25F, 0.125F}));
    EXPECT_EQ(first("COLORCORR=2 1 0.5\nEXPOSURE=2\n"), (std::vector<float>{0.25F, 0.25F, 0.25F}));
    EXPECT_EQ(first("PRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329\n"),
              (std::vector<float>{1.0F, 0.5F, 0.25F}));
    EXPECT_EQ(first("PRIMARIES=0 0 0 0 0 0 0 0\n"), (std::vector<float>{1.0F, 0.5F, 0.25F})) << "not said";
    // The white of other primaries stays white.
    put(folder_ / "white.hdr", radianceUnder("PRIMARIES=0.708 0.292 0.17 0.797 0.131 0.046 0.3127 0.329\n"));
    EXPECT_NEAR(readRadianceMap(folder_ / "white.hdr").texels[3], 1048576.0F, 1.0F);
}

TEST_F(HdrTest, HeadersThatAreNotUnderstoodAreRefusedWithTheReason) {
    const auto refused = [&](const std::string& bytes, const std::string& why) {
        put(folder_ / "a.hdr", bytes);
        expectInputError([&] { readRadianceMap(folder_ / "a.hdr"); }, "a.hdr", why);
    };
    refused(radianceUnder("EXPOSURE=0\n"), "EXPOSURE is no positive number");
    refused(radianceUnder("EXPOSURE=bright\n"), "EXPOSURE is no positive number");
    refused(radianceUnder("COLORCORR=1 -1 1\n"), "COLORCORR is no positive number");
    refused(radianceUnder("PRIMARIES=1 2 3\n"), "PRIMARIES are not eight numbers");
    refused(radianceUnder("PRIMARIES=0 0 0 0 0 0 1 1\n"), "primaries span no triangle");
    refused(radianceUnder("FORMAT=32-bit_rle_xyze\n"), "its numbers are XYZ");
    refused(radianceUnder("FORMAT=32-bit_rle_rgbe\n", "+Y 2 +X 2"), "'+Y 2 +X 2'");
}

TEST_F(HdrTest, TruncatedRadianceIsRefused) {
    const std::string whole = radiance();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        put(folder_ / "short.hdr", whole.substr(0, length));
        expectInputError([&] { readRadianceMap(folder_ / "short.hdr"); }, "short.hdr", "");
    }
}

TEST_F(HdrTest, TruncatedRunLengthsAreRefused) {
    // Rows of 8 texels: four runs of equal bytes each.
    std::string whole = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40 +X 8\n";
    const std::size_t header = whole.size();
    for (int row = 0; row < 40; ++row) whole += std::string("\2\2\0\x08\x88\x80\x88\x80\x88\x80\x88\x81", 12);
    put(folder_ / "a.hdr", whole);
    EXPECT_EQ(readRadianceMap(folder_ / "a.hdr").texels, std::vector<float>(960, 1.0F));
    for (std::size_t length = header; length < whole.size(); ++length) {
        put(folder_ / "short.hdr", whole.substr(0, length));
        expectInputError([&] { readRadianceMap(folder_ / "short.hdr"); }, "short.hdr", "truncated");
    }
}

TEST_F(HdrTest, ForeignFilesAreRefused) {
    put(folder_ / "a.hdr", png(1, 1, 8, 2, std::string(4, '\0')));
    expectInputError([&] { readRadianceMap(folder_ / "a.hdr"); }, "a.hdr", "no Radiance HDR file");
    put(folder_ / "huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 40000\n");
    expectInputError([&] { readRadianceMap(folder_ / "huge.hdr"); }, "huge.hdr", "40000x40000");
    put(folder_ / "a.png", "");
    expectInputError([&] { readRadianceMap(folder_ / "a.png"); }, "a.png", "must be .hdr or .exr");
    expectInputError([&] { readRadianceMap(folder_); }, folder_.string(), "must be .hdr or .exr");
}

ExrPicture small(const std::vector<ExrChannel>& channels) {
    ExrPicture picture;
    picture.width = 2;
    picture.height = 1;
    picture.channels = channels;
    return picture;
}

TEST_F(HdrTest, UnphysicalTexelsOfAnExrBecomeZeroAndAreCounted) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    ExrPicture picture = small({{"R", {1.0F, nan, 2.0F, 7.0F}},
                                {"G", {2.0F, -1.0F, 3.0F, 8.0F}},
                                {"B", {3.0F, 5.0F, infinite, 9.0F}}});
    picture.width = 4;
    writeExr(folder_ / "map.exr", picture);
    std::size_t replaced = 0;
    const Image map = readRadianceMap(folder_ / "map.exr", &replaced);
    EXPECT_EQ(replaced, 2U);
    const std::vector<float> expected = {1.0F, 2.0F, 3.0F, 0.0F, 0.0F, 5.0F,
                                         2.0F, 3.0F, 0.0F, 7.0F, 8.0F, 9.0F};
    EXPECT_EQ(map.texels, expected);
}

TEST_F(HdrTest, ExrMapIsColourOrGrey) {
    writeExr(folder_ / "grey.exr", small({{"Y", {1.0F, 2.0F}}}));
    const std::vector<float> expected = {1.0F, 1.0F, 1.0F, 2.0F, 2.0F, 2.0F};
    EXPECT_EQ(readRadianceMap(folder_ / "grey.exr").texels, expected);
    writeExr(folder_ / "partial.exr", small({{"R", {1.0F, 2.0F}}, {"Y", {1.0F, 2.0F}}}));
    expectInputError([&] { readRadianceMap(folder_ / "partial.exr"); }, "partial.exr", "no channels R, G, B");
}

/// Overwrites the value of an attribute that is there. type: as the file names it.
std::string withAttribute(std::string bytes, const std::string& name, const std::string& type,
                          const void* value, std::size_t size) {
    const std::size_t at = bytes.find(name + '\0' + type + '\0');
    EXPECT_NE(at, std::string::npos);
    std::memcpy(bytes.data() + at + name.size() + type.size() + 2 + 4, value, size);
    return bytes;
}

// The display window is the picture.
TEST_F(HdrTest, ExrMapIsPlacedInItsDisplayWindow) {
    ExrPicture picture = small({{"Y", {1.0F, 2.0F, 3.0F, 4.0F}}});
    picture.width = 2;
    picture.height = 2;
    writeExr(folder_ / "a.exr", picture);
    const std::string good = get(folder_ / "a.exr");
    const auto greyOf = [&](const std::array<std::int32_t, 4>& window) {
        put(folder_ / "b.exr", withAttribute(good, "displayWindow", "box2i", window.data(), sizeof(window)));
        const Image map = readRadianceMap(folder_ / "b.exr");
        std::vector<float> grey{static_cast<float>(map.width)};
        for (std::size_t i = 0; i < map.texels.size(); i += 3) grey.push_back(map.texels[i]);
        return grey;
    };
    EXPECT_EQ(greyOf({0, 0, 1, 1}), (std::vector<float>{2, 1, 2, 3, 4}));
    EXPECT_EQ(greyOf({-1, 0, 1, 2}), (std::vector<float>{3, 0, 1, 2, 0, 3, 4, 0, 0, 0}));
    EXPECT_EQ(greyOf({1, 1, 1, 1}), (std::vector<float>{1, 4}));
    EXPECT_EQ(greyOf({5, 5, 5, 5}), (std::vector<float>{1, 0}));
    const std::array<std::int32_t, 4> empty{1, 1, 0, 0};
    put(folder_ / "b.exr", withAttribute(good, "displayWindow", "box2i", empty.data(), sizeof(empty)));
    expectInputError([&] { readRadianceMap(folder_ / "b.exr"); }, "b.exr", "");
}

// Rec. 2020 to Rec. 709: the matrix of ITU-R BT.2087.
TEST_F(HdrTest, ExrMapIsConvertedFromItsPrimaries) {
    writeExr(folder_ / "a.exr", small({{"R", {0.6F, 1.0F}}, {"G", {0.3F, 1.0F}}, {"B", {0.3F, 1.0F}}}));
    const std::array<float, 8> rec2020{0.708F, 0.292F, 0.17F, 0.797F, 0.131F, 0.046F, 0.3127F, 0.329F};
    put(folder_ / "b.exr", withAttribute(get(folder_ / "a.exr"), "chromaticities", "chromaticities",
                                         rec2020.data(), sizeof(rec2020)));
    const Image map = readRadianceMap(folder_ / "b.exr");
    const glm::dvec3 exact(0.6 * 1.6605 - 0.3 * 0.5876 - 0.3 * 0.0728,
                           -0.6 * 0.1246 + 0.3 * 1.1329 - 0.3 * 0.0083,
                           -0.6 * 0.0182 - 0.3 * 0.1006 + 0.3 * 1.1187);
    for (int c = 0; c < 3; ++c) {
        // Four digits in each of three terms.
        EXPECT_NEAR(map.texels[static_cast<std::size_t>(c)], exact[c], 3 * 0.6 * 0.5e-4 + 1e-6);
        EXPECT_NEAR(map.texels[static_cast<std::size_t>(3 + c)], 1.0F, 1e-6F);
    }
}

}  // namespace
}  // namespace licht
