#include "viewer/window/font_faces.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fontconfig/fontconfig.h>
#include <stb_truetype.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <span>
#include <utility>

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;
using Faces = std::vector<std::shared_ptr<const FontFace>>;

const stbtt_fontinfo& outlines_in(const std::shared_ptr<const void>& held) {
  return *static_cast<const stbtt_fontinfo*>(held.get());
}

std::size_t number_at(const unsigned char* bytes, std::size_t at, int length) {
  std::size_t number = 0;
  for (int k = 0; k < length; ++k) number = number << 8U | bytes[at + static_cast<std::size_t>(k)];
  return number;
}

/// The tables of the face that begins there lie within the file, beyond which stb_truetype would
/// read where a file is cut off.
bool is_whole(const unsigned char* bytes, std::size_t size, std::size_t start) {
  constexpr std::size_t header = 12;
  constexpr std::size_t record = 16;  // tag, checksum, offset and length
  if (start > size || size - start < header) return false;
  const std::size_t tables = number_at(bytes, start + 4, 2);
  if (size - start - header < tables * record) return false;
  for (std::size_t table = 0; table < tables; ++table) {
    const std::size_t at = start + header + table * record;
    if (number_at(bytes, at + 8, 4) + number_at(bytes, at + 12, 4) > size) return false;
  }
  return true;
}

/// Keeps the face if it has some of the characters that are still lacking.
void keep_if_of_use(Faces& faces, std::vector<char32_t>& lacking,
                    const std::shared_ptr<const FontFace>& face) {
  if (!face) return;
  const auto found = std::erase_if(lacking, [&](char32_t one) { return face->has(one); });
  if (found > 0) faces.push_back(face);
}

/// The library where it is installed: the window does without it, if need be.
template <typename Function>
Function* in_fontconfig(const char* name) {
  static void* const library = dlopen("libfontconfig.so.1", RTLD_NOW | RTLD_LOCAL);
  return library == nullptr ? nullptr : reinterpret_cast<Function*>(dlsym(library, name));
}
#define CURVESKEL_IN_FONTCONFIG(name) const auto name##_ = in_fontconfig<decltype(name)>(#name)

/// False where fontconfig is not installed.
bool ask_fontconfig(Faces& faces, std::vector<char32_t>& lacking) {
  CURVESKEL_IN_FONTCONFIG(FcInitLoadConfigAndFonts);
  CURVESKEL_IN_FONTCONFIG(FcConfigDestroy);
  CURVESKEL_IN_FONTCONFIG(FcConfigSubstitute);
  CURVESKEL_IN_FONTCONFIG(FcDefaultSubstitute);
  CURVESKEL_IN_FONTCONFIG(FcPatternCreate);
  CURVESKEL_IN_FONTCONFIG(FcPatternDestroy);
  CURVESKEL_IN_FONTCONFIG(FcPatternAddString);
  CURVESKEL_IN_FONTCONFIG(FcPatternAddBool);
  CURVESKEL_IN_FONTCONFIG(FcPatternAddCharSet);
  CURVESKEL_IN_FONTCONFIG(FcPatternGetString);
  CURVESKEL_IN_FONTCONFIG(FcPatternGetInteger);
  CURVESKEL_IN_FONTCONFIG(FcCharSetCreate);
  CURVESKEL_IN_FONTCONFIG(FcCharSetAddChar);
  CURVESKEL_IN_FONTCONFIG(FcCharSetDestroy);
  CURVESKEL_IN_FONTCONFIG(FcFontSort);
  CURVESKEL_IN_FONTCONFIG(FcFontSetDestroy);
  if (FcFontSort_ == nullptr) return false;
  FcConfig* const config = FcInitLoadConfigAndFonts_();
  if (config == nullptr) return false;
  FcCharSet* const wanted = FcCharSetCreate_();
  for (const char32_t one : lacking) FcCharSetAddChar_(wanted, one);
  FcPattern* const pattern = FcPatternCreate_();
  FcPatternAddString_(pattern, FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
  FcPatternAddCharSet_(pattern, FC_CHARSET, wanted);
  FcPatternAddBool_(pattern, FC_OUTLINE, FcTrue);
  FcConfigSubstitute_(config, pattern, FcMatchPattern);
  FcDefaultSubstitute_(pattern);
  FcResult result = FcResultNoMatch;
  FcFontSet* const sorted = FcFontSort_(config, pattern, FcTrue, nullptr, &result);
  for (int i = 0; sorted != nullptr && i < sorted->nfont && !lacking.empty(); ++i) {
    FcChar8* file = nullptr;
    int number = 0;
    FcPatternGetInteger_(sorted->fonts[i], FC_INDEX, 0, &number);
    if (FcPatternGetString_(sorted->fonts[i], FC_FILE, 0, &file) != FcResultMatch) continue;
    constexpr int faces_of_a_file = 0xFFFF;  // above are the instances of a variable font
    keep_if_of_use(faces, lacking,
                   FontFace::open(reinterpret_cast<const char*>(file), number & faces_of_a_file));
  }
  if (sorted != nullptr) FcFontSetDestroy_(sorted);
  FcPatternDestroy_(pattern);
  FcCharSetDestroy_(wanted);
  FcConfigDestroy_(config);
  return true;
}
#undef CURVESKEL_IN_FONTCONFIG

constexpr const char* usual_fonts[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/freefont/FreeSans.ttf",
};

/// Of many scripts.
constexpr const char* usual_wide_fonts[] = {
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/google-noto-sans-cjk-fonts/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
    "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
    "/usr/share/fonts/truetype/noto/NotoSansArabic-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSansDevanagari-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSansThai-Regular.ttf",
    "/usr/share/fonts/opentype/unifont/unifont.otf",
};

}  // namespace

bool FontFace::find_outlines() {
  const auto* const bytes = static_cast<const unsigned char*>(bytes_);
  const std::size_t of_collection = 16 + 4 * static_cast<std::size_t>(number_);  // its header
  if (number_ < 0 || size_ < of_collection) return false;
  const int start = stbtt_GetFontOffsetForIndex(bytes, number_);
  if (start < 0 || !is_whole(bytes, size_, static_cast<std::size_t>(start))) return false;
  auto outlines = std::make_shared<stbtt_fontinfo>();
  if (stbtt_InitFont(outlines.get(), bytes, start) == 0) return false;
  const float line = stbtt_ScaleForPixelHeight(outlines.get(), 1);
  const float letter = stbtt_ScaleForMappingEmToPixels(outlines.get(), 1);
  if (!(line > 0) || !(letter > 0)) return false;
  lines_per_letter_ = letter / line;
  outlines_ = std::move(outlines);
  return true;
}

std::shared_ptr<const FontFace> FontFace::open(const fs::path& file, int number) {
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return nullptr;
  std::shared_ptr<FontFace> face(new FontFace);
  struct stat about = {};
  if (fstat(opened, &about) == 0 && S_ISREG(about.st_mode) && about.st_size > 0) {
    face->size_ = static_cast<std::size_t>(about.st_size);
    void* const bytes = mmap(nullptr, face->size_, PROT_READ, MAP_PRIVATE, opened, 0);
    if (bytes != MAP_FAILED) face->bytes_ = bytes;
  }
  close(opened);
  face->number_ = number;
  if (face->bytes_ == nullptr || !face->find_outlines()) return nullptr;
  return face;
}

FontFace::~FontFace() {
  if (bytes_ != nullptr) munmap(bytes_, size_);
}

bool FontFace::has(char32_t character) const {
  return stbtt_FindGlyphIndex(&outlines_in(outlines_), static_cast<int>(character)) != 0;
}

std::shared_ptr<const FontFace> usual_face() {
  for (const char* const file : usual_fonts) {
    if (auto face = FontFace::open(file)) return face;
  }
  return nullptr;
}

Faces faces_with(const std::vector<char32_t>& characters) {
  Faces faces;
  std::vector<char32_t> lacking = characters;
  return ask_fontconfig(faces, lacking) ? faces : faces_in_usual_places(characters);
}

Faces faces_in_usual_places(const std::vector<char32_t>& characters) {
  Faces faces;
  std::vector<char32_t> lacking = characters;
  for (const auto& list : {std::span<const char* const>(usual_fonts), {usual_wide_fonts}}) {
    for (const char* const file : list) keep_if_of_use(faces, lacking, FontFace::open(file));
  }
  return faces;
}

}  // namespace curveskel::viewer
