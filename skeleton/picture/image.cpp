#include "skeleton/picture/image.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <curveskel/error.hpp>
#include "base/parallel.hpp"

namespace curveskel {
namespace {

constexpr std::size_t channels = 3;
constexpr std::size_t rows_per_strip = 64;  // packed on their own, so that threads share the work

/// Eight-bit pixels, with a pixel of zeros before each row and a row of zeros above the first: what
/// PNG's filters see beyond the edges.
struct PaddedBytes {
  std::size_t stride;
  std::vector<unsigned char> bytes;
  [[nodiscard]] unsigned char* row(std::size_t y) {
    return bytes.data() + (y + 1) * stride + channels;
  }
};

PaddedBytes bytes_of(const Image& image, int threads) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const std::size_t stride = channels * (width + 1);
  PaddedBytes result{stride, std::vector<unsigned char>(stride * (height + 1), 0)};
  parallel_for(height, rows_per_strip, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      unsigned char* byte = result.row(y);
      for (std::size_t x = 0; x < width; ++x) {
        for (const float value : image.pixels[y * width + x]) {
          const float scaled = std::clamp(value, 0.0F, 1.0F) * 255.0F;
          *byte++ = static_cast<unsigned char>(std::lround(scaled));
        }
      }
    }
  });
  return result;
}

/// The guess of PNG's filters 0 to 4 at a byte, from those to the left, above, and above the left.
template <int filter>
int expected(int left, int above, int corner) {
  if constexpr (filter == 1) return left;
  if constexpr (filter == 2) return above;
  if constexpr (filter == 3) return (left + above) / 2;
  if constexpr (filter == 4) {
    const int to_left = std::abs(above - corner);
    const int to_above = std::abs(left - corner);
    const int to_corner = std::abs(left + above - 2 * corner);
    const int nearer = to_above <= to_corner ? above : corner;
    return to_left <= to_above && to_left <= to_corner ? left : nearer;
  }
  return 0;
}

/// Writes the row as the filter leaves it, and returns the sum of what is left: a row of small
/// values packs well.
template <int filter>
long filter_row(const unsigned char* row, std::size_t stride, unsigned char* filtered) {
  const std::size_t count = stride - channels;
  const unsigned char* left = row - channels;
  const unsigned char* above = row - stride;
  const unsigned char* corner = above - channels;
  int sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int rest = row[i] - expected<filter>(left[i], above[i], corner[i]);
    filtered[i] = static_cast<unsigned char>(rest);
    sum += std::abs(static_cast<int>(static_cast<signed char>(rest)));
  }
  return sum;
}

/// The rows of a strip, each behind the number of the filter that leaves least.
std::vector<unsigned char> filtered_strip(PaddedBytes& picture, std::size_t begin,
                                          std::size_t end) {
  constexpr std::array filters{&filter_row<0>, &filter_row<1>, &filter_row<2>, &filter_row<3>,
                               &filter_row<4>};
  const std::size_t count = picture.stride - channels;
  std::vector<unsigned char> result;
  result.reserve((end - begin) * (count + 1));
  std::vector<unsigned char> best(count);
  std::vector<unsigned char> other(count);
  for (std::size_t y = begin; y < end; ++y) {
    std::size_t best_filter = 0;
    long least = filters[0](picture.row(y), picture.stride, best.data());
    for (std::size_t f = 1; f < filters.size(); ++f) {
      const long sum = filters[f](picture.row(y), picture.stride, other.data());
      if (sum >= least) continue;
      least = sum;
      best_filter = f;
      best.swap(other);
    }
    result.push_back(static_cast<unsigned char>(best_filter));
    result.insert(result.end(), best.begin(), best.end());
  }
  return result;
}

struct PackedStrip {
  std::string bytes;  ///< a part of one deflate stream; empty without memory
  uLong checksum = 0;
  std::size_t size = 0;  ///< before packing
};

PackedStrip packed(std::vector<unsigned char> plain, bool is_last) {
  constexpr int level = 6;  // a third of the time of 8, a few percent more bytes
  constexpr int raw = -15;  // the largest window, no header
  constexpr int usual_memory = 8;
  PackedStrip result;
  result.size = plain.size();
  result.checksum = adler32(1, plain.data(), static_cast<uInt>(plain.size()));
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, raw, usual_memory, Z_DEFAULT_STRATEGY) != Z_OK) {
    return result;
  }
  constexpr std::size_t end_of_flush = 16;
  result.bytes.resize(deflateBound(&stream, static_cast<uLong>(plain.size())) + end_of_flush);
  stream.next_in = plain.data();
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.bytes.data());
  stream.avail_out = static_cast<uInt>(result.bytes.size());
  deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  result.bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

void append_big_endian(std::string& png, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) png += static_cast<char>(value >> shift & 255U);
}

void append_chunk(std::string& png, std::string_view type, std::string_view data) {
  append_big_endian(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = png.size();
  png.append(type).append(data);
  append_big_endian(
      png, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(png.data() + begin),
                                            static_cast<uInt>(png.size() - begin))));
}

}  // namespace

std::string png_from(const Image& image, int threads) {
  PaddedBytes picture = bytes_of(image, threads);
  const auto height = static_cast<std::size_t>(image.height);
  std::vector<PackedStrip> strips((height + rows_per_strip - 1) / rows_per_strip);
  parallel_for(strips.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const std::size_t bottom = std::min(height, (s + 1) * rows_per_strip);
      strips[s] =
          packed(filtered_strip(picture, s * rows_per_strip, bottom), s + 1 == strips.size());
    }
  });
  std::string data("\x78\x9C", 2);  // zlib's header
  uLong checksum = adler32(0, nullptr, 0);
  for (const PackedStrip& strip : strips) {
    if (strip.bytes.empty()) {
      throw Error(Fault::output, "no memory to pack a picture of " + std::to_string(image.width) +
                                     " x " + std::to_string(image.height) +
                                     " pixels; make it smaller");
    }
    data += strip.bytes;
    checksum = adler32_combine(checksum, strip.checksum, static_cast<z_off_t>(strip.size));
  }
  append_big_endian(data, static_cast<std::uint32_t>(checksum));
  std::string png("\x89PNG\r\n\x1A\n");
  std::string header;
  append_big_endian(header, static_cast<std::uint32_t>(image.width));
  append_big_endian(header, static_cast<std::uint32_t>(image.height));
  header += std::string("\x08\x02\0\0\0", 5);  // 8 bits of red, green and blue
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", data);
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace curveskel
