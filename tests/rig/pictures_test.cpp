// Laws of pictures beside a file: kinds that glTF does not have become PNG, found where they are.
#include <gtest/gtest.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/rig_files.hpp>
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"

namespace curveskel::picture_kinds_laws {
namespace {

namespace fs = std::filesystem;

/// Two pixels beside each other, red and half-seen blue, from BGRA.
std::string tga(bool has_alpha) {
  std::string bytes(18, '\0');
  bytes[2] = 2;
  bytes[12] = 2;
  bytes[14] = 1;
  bytes[16] = static_cast<char>(has_alpha ? 32 : 24);
  bytes[17] = static_cast<char>(has_alpha ? 0x28 : 0x20);
  bytes += std::string("\x00\x00\xff", 3) + (has_alpha ? "\xff" : "");
  bytes += std::string("\xff\x00\x00", 3) + (has_alpha ? "\x80" : "");
  return bytes;
}

std::string bmp() {
  std::string bytes = "BM";
  const auto number = [&](std::uint32_t value, int count) {
    for (int k = 0; k < count; ++k) bytes += static_cast<char>(value >> 8U * unsigned(k) & 255U);
  };
  number(62, 4);
  number(0, 4);
  number(54, 4);
  number(40, 4);
  number(2, 4);
  number(1, 4);
  number(1, 2);
  number(24, 2);
  for (int k = 0; k < 6; ++k) number(0, 4);
  return bytes + std::string("\x00\x00\xff\xff\x00\x00\x00\x00", 8);
}

class Pictures : public testing::Test {
 protected:
  Pictures() {
    (void)folder_.write("looks.mtl", "newmtl skin\nmap_Kd skin.dat\n");
    (void)folder_.write(
        "t.obj",
        "mtllib looks.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nusemtl skin\n"
        "f 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 2/1 3/1 4/1\nf 1/1 4/1 3/1\n");
  }

  [[nodiscard]] EditedFile rigged() const {
    const auto edited = format_rig_into(folder_.path() / "t.obj", random_rig(4, 3, "bone "),
                                        {RigFormat::glb, OldRig::replaced, "rig", "a test"});
    EXPECT_TRUE(edited);
    return edited.value_or(EditedFile{});
  }

  OwnFolder folder_;
};

TEST_F(Pictures, OfOtherKindsComeOutAsPngWithTheirPixels) {
  struct Case {
    std::string bytes;
    int channels;
    std::vector<stbi_uc> pixels;
  };
  const std::vector<Case> cases{{tga(false), 3, {255, 0, 0, 0, 0, 255}},
                                {tga(true), 4, {255, 0, 0, 255, 0, 0, 255, 128}},
                                {bmp(), 3, {255, 0, 0, 0, 0, 255}}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.bytes.size());
    (void)folder_.write("skin.dat", one.bytes);
    const EditedFile edited = rigged();
    EXPECT_TRUE(edited.notes.empty());
    const Glb glb = glb_of(edited.bytes);
    ASSERT_EQ(glb.json["images"].size(), 1U);
    EXPECT_EQ(glb.json["images"][0]["mimeType"], "image/png");
    const auto png = glb.of_view<stbi_uc>(glb.json["images"][0]["bufferView"].get<std::size_t>());
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> rows(
        stbi_load_from_memory(png.data(), int(png.size()), &width, &height, &channels, 0),
        &stbi_image_free);
    ASSERT_TRUE(rows);
    EXPECT_EQ(width, 2);
    EXPECT_EQ(height, 1);
    ASSERT_EQ(channels, one.channels);
    EXPECT_EQ(std::vector<stbi_uc>(rows.get(), rows.get() + one.pixels.size()), one.pixels);
  }
}

TEST_F(Pictures, ThatAreNoneOrCutShortAreSaidToBe) {
  std::string wide = tga(true);
  wide[13] = wide[15] = '\x7f';  // 32,514 x 32,513 pixels
  for (const std::string& bytes : {std::string("no picture"), tga(true).substr(0, 12), wide}) {
    (void)folder_.write("skin.dat", bytes);
    const EditedFile edited = rigged();
    ASSERT_EQ(edited.notes.size(), 1U);
    EXPECT_NE(edited.notes[0].find("convert it"), std::string::npos);
    EXPECT_FALSE(glb_of(edited.bytes).json.contains("images"));
  }
}

TEST_F(Pictures, AreSoughtWherePicturesMostlyAre) {
  for (const char* place : {"textures", "Textures", "images", "looks", "looks.fbm"}) {
    const fs::path folder = folder_.path() / place;
    fs::create_directories(folder);
    (void)folder_.write(std::string(place) + "/skin.dat", tga(false));
    EXPECT_TRUE(rigged().notes.empty()) << place;
    fs::remove_all(folder);
  }
  EXPECT_EQ(rigged().notes.size(), 1U);
}

}  // namespace
}  // namespace curveskel::picture_kinds_laws
