#include "licht/image/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <span>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/core/memory.h"
#include "licht/image/exr_header.h"

namespace licht {
namespace {

// Lines per step of reading. The library keeps the chunk it decoded last, so a step may end within a chunk.
constexpr int kLinesAtOnce = 16;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
    throw InputError(fmt::format("{}: {}", path.string(), why));
}

/// Tells flat single-part files from all others before the library opens them as such.
void requireFlatSinglePart(const std::filesystem::path& path) {
    requireRegularFile(path);
    bool tiled = false;
    bool deep = false;
    bool multi_part = false;
    if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, multi_part)) refuse(path, "is no OpenEXR file");
    if (deep) refuse(path, "deep OpenEXR files are not supported");
    if (multi_part) refuse(path, "multi-part OpenEXR files are not supported");
}

/// The library sizes its tables after the header's word when the file is opened, so it has to know the limit
/// itself.
void limitLibraryOnce() {
    static const bool limited = [] {
        Imf::Header::setMaxImageSize(kMaxImageSide, kMaxImageSide);
        Imf::Header::setMaxTileSize(kMaxImageSide, kMaxImageSide);
        return true;
    }();
    static_cast<void>(limited);
}

ExrPicture describe(const Imf::Header& header, const std::filesystem::path& path) {
    ExrPicture picture;
    const Imath::Box2i& window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
        refuse(path, fmt::format("its size of {}x{} is not within 1..{}", width, height, kMaxImageSide));
    if (width * height > kMaxImageTexels)
        refuse(path, fmt::format("its size of {}x{} is more than 2^28 texels", width, height));
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    const Imath::Box2i& display = header.displayWindow();
    const std::int64_t display_width = std::int64_t{display.max.x} - display.min.x + 1;
    const std::int64_t display_height = std::int64_t{display.max.y} - display.min.y + 1;
    if (display_width < 1 || display_height < 1 || display_width > kMaxImageSide ||
        display_height > kMaxImageSide)
        refuse(path, fmt::format("its display window of {}x{} is not within 1..{}", display_width,
                                 display_height, kMaxImageSide));
    picture.display = {std::int64_t{display.min.x} - window.min.x, std::int64_t{display.min.y} - window.min.y,
                       static_cast<int>(display_width), static_cast<int>(display_height)};
    if (Imf::hasChromaticities(header)) {
        const Imf::Chromaticities& c = Imf::chromaticities(header);
        const auto xy = [](const Imath::V2f& v) { return glm::dvec2(v.x, v.y); };
        picture.primaries = {xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
    }
    const Imf::ChannelList& channels = header.channels();
    for (auto i = channels.begin(); i != channels.end(); ++i) {
        if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
            refuse(path, fmt::format("channel '{}' is subsampled, which is not supported", i.name()));
        picture.channels.push_back({i.name(), {}});
    }
    if (picture.channels.empty()) refuse(path, "has no channels");
    for (auto i = header.begin(); i != header.end(); ++i)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
            picture.attributes.emplace_back(i.name(), text->value());
    return picture;
}

/// Reads all lines. The planes grow with what the file delivers, so that a small file that promises a huge
/// picture does not cost the memory of one.
void readLines(Imf::InputFile& file, ExrPicture& picture) {
    const Imath::Box2i& window = file.header().dataWindow();
    const auto width = static_cast<std::size_t>(picture.width);
    Imf::FrameBuffer frame;
    for (ExrChannel& channel : picture.channels) {
        channel.values.reserve(width * static_cast<std::size_t>(picture.height));
        frame.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values.data(), window));
    }
    file.setFrameBuffer(frame);
    for (int row = 0; row < picture.height; row += kLinesAtOnce) {
        const int end = std::min(picture.height, row + kLinesAtOnce);
        for (ExrChannel& channel : picture.channels)
            channel.values.resize(width * static_cast<std::size_t>(end));
        file.readPixels(window.min.y + row, window.min.y + end - 1);
    }
}

}  // namespace

const ExrChannel* ExrPicture::find(const std::string& name) const {
    const auto found = std::ranges::find(channels, name, &ExrChannel::name);
    return found == channels.end() ? nullptr : &*found;
}

void writeExr(const std::filesystem::path& path, const ExrPicture& picture) {
    assert(picture.width > 0 && picture.height > 0 && !picture.channels.empty());
    // The stream in memory: the library's own file writes its last bytes in a destructor, where an error is
    // lost.
    Imf::StdOSStream stream;
    try {
        Imf::Header header(picture.width, picture.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709
        for (const auto& [name, value] : picture.attributes) header.insert(name, Imf::StringAttribute(value));
        Imf::FrameBuffer frame;
        for (const ExrChannel& channel : picture.channels) {
            assert(channel.values.size() ==
                   static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
            header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
            frame.insert(channel.name,
                         Imf::Slice::Make(Imf::FLOAT, channel.values.data(), header.dataWindow()));
        }
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writePixels(picture.height);
    } catch (const std::exception& error) {
        throw DeviceError(fmt::format("{}: writing failed: {}", path.string(), error.what()));
    }
    const std::string bytes = stream.str();
    writeFile(path, std::as_bytes(std::span(bytes)));
}

ExrPicture readExr(const std::filesystem::path& path) {
    try {
        requireFlatSinglePart(path);
        requireExrHeaderWithinFile(path);
        limitLibraryOnce();
        Imf::InputFile file(path.c_str());
        ExrPicture picture = describe(file.header(), path);
        if (!file.isComplete()) refuse(path, "is truncated");
        requireMemory(static_cast<double>(sizeof(float)) * picture.width * picture.height *
                          static_cast<double>(picture.channels.size()),
                      fmt::format("{}: its {} channels of {}x{} take", path.string(), picture.channels.size(),
                                  picture.width, picture.height));
        readLines(file, picture);
        return picture;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        refuse(path, error.what());
    }
}

}  // namespace licht
