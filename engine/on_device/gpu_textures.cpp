#include "licht/on_device/gpu_textures.h"

#include <fmt/format.h>

#include "licht/colour/transfer.h"
#include "licht/core/error.h"
#include "licht/shared/constants.h"
#include "licht/shared/material.h"

namespace licht {

// Textures go to pages in order, first fit; one texture lies in one page.
GpuTextures::GpuTextures(Uploads& uploads, const std::vector<Texture>& textures) {
    constexpr std::size_t kPageWords = std::size_t{1} << kTexelsPerPageLog2;
    std::vector<std::vector<uint>> pages(1);
    std::vector<TextureRecord> records;
    for (const Texture& t : textures) {
        const std::size_t words = t.bytes.size() / 4;
        if (words > kPageWords)
            throw InputError(fmt::format("texture '{}' has {} words, and a page holds at most {}", t.name,
                                         words, kPageWords));
        std::size_t page = 0;
        while (page < pages.size() && pages[page].size() + words > kPageWords) ++page;
        if (page == kTexturePages)
            throw InputError(
                fmt::format("texture '{}': the scene's textures take more than {} pages of {} words", t.name,
                            kTexturePages, kPageWords));
        if (page == pages.size()) pages.emplace_back();
        TextureRecord record{};
        record.page = static_cast<uint>(page);
        record.first_word = static_cast<uint>(pages[page].size());
        record.width = t.width;
        record.height = t.height;
        record.words_per_texel = t.bits == 16 ? 2 : 1;
        wide_texels_ = wide_texels_ || t.bits == 16;
        records.push_back(record);
        for (std::size_t i = 0; i < words; ++i) {
            const std::uint8_t* b = &t.bytes[4 * i];
            pages[page].push_back(uint{b[0]} | uint{b[1]} << 8U | uint{b[2]} << 16U | uint{b[3]} << 24U);
        }
    }
    for (const std::vector<uint>& page : pages) pages_.push_back(uploads.buffer("texels", page));
    textures_ = uploads.buffer("textures", records);
    std::vector<float> table;
    for (int i = 0; i < 256; ++i) table.push_back(linearFromSrgb(static_cast<float>(i) / 255.0F));
    srgb_table_ = uploads.buffer("srgb_table", table);
}

void GpuTextures::addTo(std::vector<gpu::BoundResource>& resources, const gpu::Buffer& none) const {
    resources.push_back({"Textures", textures_ ? &textures_ : &none});
    resources.push_back({"SrgbTable", srgb_table_ ? &srgb_table_ : &none});
    for (const gpu::Buffer& page : pages_) resources.push_back({"texel_pages", &page});
    if (pages_.empty()) resources.push_back({"texel_pages", &none});
}

void GpuTextures::addTo(gpu::SpecConstants& constants) const {
    constants[kConstantTexturePages] = static_cast<uint>(pages_.size());
    constants[kConstantWideTexels] = wide_texels_ ? 1U : 0U;
}

}  // namespace licht
