#include "licht/image/files.h"

#include <fmt/format.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cctype>
#include <climits>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/core/memory.h"
#include "licht/image/decoder_memory.h"
#include "licht/image/exr.h"
#include "licht/image/hdr_header.h"
#include "licht/image/jpeg_tables.h"

namespace licht {
namespace {
struct DecoderFailure : std::runtime_error {
    DecoderFailure() : std::runtime_error("the codes of a picture contradict each other") {}
};
}  // namespace
}  // namespace licht

// The package's library ends the program where the codes of a damaged JPEG contradict each other; compiled
// here, that is an error like others, and what was taken until then is given back.
#define STBI_ASSERT(holds) ((holds) ? static_cast<void>(0) : throw licht::DecoderFailure())
#define STBI_MALLOC licht::takeDecoderMemory
#define STBI_REALLOC licht::resizeDecoderMemory
#define STBI_FREE licht::giveDecoderMemory
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace licht {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
    throw InputError(fmt::format("{}: {}", name, why));
}

/// Bytes for stb_image's callbacks, which remember a read past the end: stb_image itself takes zeros for what
/// is missing, and would look for the next run of a truncated Radiance file among them for ever.
class Source {
public:
    explicit Source(std::span<const std::byte> bytes) : bytes_(bytes) {}
    [[nodiscard]] bool readPastEnd() const { return read_past_end_; }

    static constexpr stbi_io_callbacks callbacks() {
        return {[](void* self, char* to, int size) { return static_cast<Source*>(self)->read(to, size); },
                [](void* self, int count) { static_cast<Source*>(self)->skip(count); },
                [](void* self) { return static_cast<Source*>(self)->bytes_.empty() ? 1 : 0; }};
    }

private:
    // Refills of stb_image's buffer may be cut short by the end of the file; they are larger than any single
    // value.
    static constexpr std::size_t kLargestValue = 4;
    // What follows the end lets every decoder finish or fail: a run of one in Radiance, no marker in JPEG, no
    // chunk in PNG.
    static constexpr int kFiller = 0x81;
    static constexpr std::size_t kFillerLength = 128;

    int read(char* to, int size) {
        const auto wanted = static_cast<std::size_t>(size);
        const std::size_t got = std::min(wanted, bytes_.size());
        if (got == 0) {
            read_past_end_ = true;
            const std::size_t filled = std::min(wanted, kFillerLength);
            std::memset(to, kFiller, filled);
            return static_cast<int>(filled);
        }
        if (got < wanted && wanted <= kLargestValue) read_past_end_ = true;
        std::memcpy(to, bytes_.data(), got);
        bytes_ = bytes_.subspan(got);
        return static_cast<int>(got);
    }
    void skip(int count) {
        const auto wanted = static_cast<std::size_t>(std::max(count, 0));
        if (wanted > bytes_.size()) read_past_end_ = true;
        bytes_ = bytes_.subspan(std::min(wanted, bytes_.size()));
    }

    std::span<const std::byte> bytes_;
    bool read_past_end_ = false;
};

struct Freed {
    void operator()(void* memory) const { stbi_image_free(memory); }
};

const stbi_uc* stbBytes(std::span<const std::byte> bytes) {
    return reinterpret_cast<const stbi_uc*>(bytes.data());
}

struct Size {
    int width = 0;
    int height = 0;
};

/// The size in the header, once the header is known to be whole and harmless.
Size requireSaneSize(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() > INT_MAX) refuse(name, "is larger than 2 GiB");
    Size size;
    int channels = 0;
    if (stbi_info_from_memory(stbBytes(bytes), static_cast<int>(bytes.size()), &size.width, &size.height,
                              &channels) == 0)
        refuse(name, "its image header is broken or promises too large a picture");
    if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide || size.height > kMaxImageSide)
        refuse(name,
               fmt::format("its size of {}x{} is not within 1..{}", size.width, size.height, kMaxImageSide));
    if (std::int64_t{size.width} * size.height > kMaxImageTexels)
        refuse(name, fmt::format("its size of {}x{} is more than 2^28 texels", size.width, size.height));
    return size;
}

/// Calls one of stb_image's load functions. Refuses broken and truncated files.
template <typename Texel, typename Load>
std::unique_ptr<Texel, Freed> decode(Load load, std::span<const std::byte> bytes, const std::string& name,
                                     int channels) {
    Source source(bytes);
    const stbi_io_callbacks callbacks = Source::callbacks();
    Size size;
    int stored_channels = 0;
    std::unique_ptr<Texel, Freed> texels;
    try {
        texels.reset(load(&callbacks, &source, &size.width, &size.height, &stored_channels, channels));
    } catch (const DecoderFailure&) {
        giveAllDecoderMemory();
        refuse(name, "broken image (its codes contradict each other)");
    }
    if (source.readPastEnd()) refuse(name, "the image is truncated");
    if (!texels) refuse(name, fmt::format("broken image ({})", stbi_failure_reason()));
    return texels;
}

template <std::size_t size>
bool startsWith(std::span<const std::byte> bytes, const std::array<unsigned char, size>& magic) {
    return bytes.size() >= size && std::memcmp(bytes.data(), magic.data(), size) == 0;
}

bool isPng(std::span<const std::byte> bytes) {
    return startsWith<8>(bytes, {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'});
}

bool isJpeg(std::span<const std::byte> bytes) {
    return startsWith<3>(bytes, {0xff, 0xd8, 0xff});
}

/// Nothing where the file does not say its primaries, or says what is read anyway.
void convertToRec709(Image& map, const std::optional<Primaries>& primaries, const std::string& name) {
    if (!primaries || areRec709(*primaries)) return;
    const glm::dmat3 rec709_from_file = rec709FromPrimaries(*primaries);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(rec709_from_file[column][row]))
                refuse(name, "its primaries span no triangle of colours");
    for (std::size_t i = 0; i < map.texels.size(); i += 3) {
        const glm::dvec3 rgb =
            rec709_from_file * glm::dvec3(map.texels[i], map.texels[i + 1], map.texels[i + 2]);
        for (std::size_t c = 0; c < 3; ++c) map.texels[i + c] = static_cast<float>(rgb[static_cast<int>(c)]);
    }
}

Image readHdr(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path, INT_MAX);
    if (stbi_is_hdr_from_memory(stbBytes(bytes), static_cast<int>(bytes.size())) == 0)
        refuse(path.string(), "is no Radiance HDR file");
    const HdrHeader header = readHdrHeader(bytes, path.string());
    const Size size = requireSaneSize(bytes, path.string());
    // As decoded, and as a map.
    requireMemory(2.0 * 3.0 * sizeof(float) * size.width * size.height,
                  fmt::format("{}: its {}x{} texels take", path.string(), size.width, size.height));
    const auto texels = decode<float>(stbi_loadf_from_callbacks, bytes, path.string(), 3);
    Image map(size.width, size.height, 3);
    std::copy_n(texels.get(), map.texels.size(), map.texels.begin());
    if (header.divisor != glm::dvec3(1.0))
        for (std::size_t i = 0; i < map.texels.size(); ++i)
            map.texels[i] = static_cast<float>(static_cast<double>(map.texels[i]) /
                                               header.divisor[static_cast<int>(i % 3)]);
    convertToRec709(map, header.primaries, path.string());
    return map;
}

/// R, G, B of an EXR file, or three times its Y. The display window is the picture: what of it the file has
/// no data for is black, and data beside it is no part of it.
Image readExrMap(const std::filesystem::path& path) {
    const ExrPicture picture = readExr(path);
    std::array<const ExrChannel*, 3> planes = {picture.find("R"), picture.find("G"), picture.find("B")};
    if (const ExrChannel* grey = picture.find("Y"); grey != nullptr && planes == decltype(planes){})
        planes.fill(grey);
    if (std::ranges::count(planes, nullptr) != 0)
        refuse(path.string(), "has no channels R, G, B and no channel Y");
    const PictureWindow& display = picture.display;
    if (std::int64_t{display.width} * display.height > kMaxImageTexels)
        refuse(path.string(), fmt::format("its display window of {}x{} is more than 2^28 texels",
                                          display.width, display.height));
    requireMemory(
        3.0 * sizeof(float) * display.width * display.height,
        fmt::format("{}: its display window of {}x{} takes", path.string(), display.width, display.height));
    Image map(display.width, display.height, 3);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::int64_t to_x = std::int64_t{x} - display.x;
            const std::int64_t to_y = std::int64_t{y} - display.y;
            if (to_x < 0 || to_y < 0 || to_x >= display.width || to_y >= display.height) continue;
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x);
            for (int c = 0; c < 3; ++c)
                map.at(static_cast<int>(to_x), static_cast<int>(to_y), c) =
                    planes[static_cast<std::size_t>(c)]->values[i];
        }
    }
    convertToRec709(map, picture.primaries, path.string());
    return map;
}

std::size_t replaceUnphysical(Image& map) {
    std::size_t replaced = 0;
    for (std::size_t texel = 0; texel < map.texels.size(); texel += 3) {
        bool bad_texel = false;
        for (std::size_t i = texel; i < texel + 3; ++i) {
            const bool bad = !std::isfinite(map.texels[i]) || map.texels[i] < 0.0F;
            if (bad) map.texels[i] = 0.0F;
            bad_texel = bad_texel || bad;
        }
        replaced += bad_texel ? 1 : 0;
    }
    return replaced;
}

std::string lowerCaseEnding(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return ending;
}

/// The nearest of the 256 codes; NaN becomes 0.
std::uint8_t codeOf(float value) {
    if (!(value > 0.0F)) return 0;
    return static_cast<std::uint8_t>(std::lround(std::min(value, 1.0F) * 255.0F));
}

/// Signature and IHDR.
constexpr std::ptrdiff_t kPngHeaderBytes = 8 + 25;

/// A chunk tEXt (PNG 1.2, 4.2.3), with its length and its CRC (annex D).
constexpr auto kSoftwareChunk = [] {
    constexpr std::string_view kText("tEXtSoftware\0Licht", 18);
    std::array<std::byte, kText.size() + 8> chunk{};
    const auto putWord = [&chunk](std::size_t at, std::uint32_t word) {
        for (std::size_t i = 0; i < 4; ++i) chunk[at + i] = static_cast<std::byte>(word >> (24U - 8U * i));
    };
    std::uint32_t crc = 0xffffffffU;
    for (std::size_t i = 0; i < kText.size(); ++i) {
        chunk[4 + i] = static_cast<std::byte>(kText[i]);
        crc ^= static_cast<std::uint32_t>(static_cast<unsigned char>(kText[i]));
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0U ? crc >> 1U ^ 0xedb88320U : crc >> 1U;
    }
    putWord(0, static_cast<std::uint32_t>(kText.size() - 4));
    putWord(4 + kText.size(), ~crc);
    return chunk;
}();

}  // namespace

void writePng(const std::filesystem::path& path, const Image& picture) {
    assert(picture.channels == 1 || picture.channels == 3 || picture.channels == 4);
    assert(picture.width > 0 && picture.height > 0);
    // stb_image_write counts the raw bytes, one filter byte a row included, in an int.
    if ((std::int64_t{picture.width} * picture.channels + 1) * picture.height > INT_MAX)
        refuse(path.string(), fmt::format("{}x{} is too large for a PNG", picture.width, picture.height));
    std::vector<std::uint8_t> codes(picture.texels.size());
    std::ranges::transform(picture.texels, codes.begin(), codeOf);
    std::vector<std::byte> png;
    const auto append = [](void* to, void* data, int size) {
        const auto* bytes = static_cast<const std::byte*>(data);
        static_cast<std::vector<std::byte>*>(to)->assign(bytes, bytes + size);
    };
    if (stbi_write_png_to_func(append, &png, picture.width, picture.height, picture.channels, codes.data(),
                               picture.width * picture.channels) == 0)
        throw DeviceError(fmt::format("{}: encoding the PNG failed", path.string()));
    png.insert(png.begin() + kPngHeaderBytes, kSoftwareChunk.begin(), kSoftwareChunk.end());
    writeFile(path, png);
}

bool isOwnPng(const std::filesystem::path& path) {
    try {
        const std::vector<std::byte> bytes = readFile(path);
        return isPng(bytes) && bytes.size() >= kPngHeaderBytes + kSoftwareChunk.size() &&
               std::equal(kSoftwareChunk.begin(), kSoftwareChunk.end(), bytes.begin() + kPngHeaderBytes);
    } catch (const InputError&) {
        return false;
    }
}

Image readRadianceMap(const std::filesystem::path& path, std::size_t* replaced) {
    const std::string ending = lowerCaseEnding(path);
    if (ending != ".hdr" && ending != ".exr") refuse(path.string(), "a radiance map must be .hdr or .exr");
    Image map = ending == ".hdr" ? readHdr(path) : readExrMap(path);
    const std::size_t count = replaceUnphysical(map);
    if (replaced != nullptr) *replaced = count;
    return map;
}

ImageShape shapeOfImage(std::span<const std::byte> bytes, const std::string& name) {
    if (isJpeg(bytes))
        requireSoundJpegTables(bytes, name);
    else if (!isPng(bytes))
        refuse(name, "is neither PNG nor JPEG");
    const Size size = requireSaneSize(bytes, name);
    const bool wide = stbi_is_16_bit_from_memory(stbBytes(bytes), static_cast<int>(bytes.size())) != 0;
    return {size.width, size.height, wide ? 16 : 8};
}

EncodedImage decodeImage(std::span<const std::byte> bytes, const std::string& name) {
    static_assert(std::endian::native == std::endian::little,
                  "16-bit texels are passed on as stb_image stores them");
    const ImageShape shape = shapeOfImage(bytes, name);
    EncodedImage image;
    image.width = shape.width;
    image.height = shape.height;
    image.bits = shape.bits;
    // Memory is taken after decoding: a small file that promises a huge picture fails before that.
    const auto copy = [&](const void* texels) {
        const auto* first = static_cast<const std::uint8_t*>(texels);
        image.bytes.assign(first, first + shape.bytes());
    };
    if (image.bits == 16)
        copy(decode<stbi_us>(stbi_load_16_from_callbacks, bytes, name, 4).get());
    else
        copy(decode<stbi_uc>(stbi_load_from_callbacks, bytes, name, 4).get());
    return image;
}

}  // namespace licht
