#include "rig/fbx/fbx_records.hpp"

#include <zlib.h>

#include <bit>
#include <cstring>
#include <limits>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t version = 7400;
constexpr std::string_view magic("Kaydara FBX Binary  \0\x1a\0", 23);
constexpr std::string_view end_of_records("\0\0\0\0\0\0\0\0\0\0\0\0\0", 13);
// Readers that check it want these bytes behind the records, at a multiple of 16 in part.
constexpr std::string_view first_mark(
    "\xfa\xbc\xab\x09\xd0\xc8\xd4\x66\xb1\x76\xfb\x83\x1c\xf7\x26\x7e", 16);
constexpr std::string_view last_mark(
    "\xf8\x5a\x8c\x6a\xde\xf5\xd9\x7e\xec\xe9\x0c\xe3\x75\x8f\x29\x0b", 16);

}  // namespace

FbxRecords::FbxRecords() {
  bytes_ = magic;
  put_word(version);
}

void FbxRecords::put_number(const void* number, std::size_t size) {
  bytes_.append(static_cast<const char*>(number), size);
}

void FbxRecords::put_word(std::size_t number) {
  const auto word = static_cast<std::uint32_t>(number);
  put_number(&word, sizeof word);
}

void FbxRecords::set_word(std::size_t at, std::size_t number) {
  const auto word = static_cast<std::uint32_t>(number);
  std::memcpy(bytes_.data() + at, &word, sizeof word);
}

void FbxRecords::begin(std::string_view name) {
  if (!open_.empty() && !open_.back().has_records) {
    end_values(open_.back());
    open_.back().has_records = true;
  }
  Open record;
  record.start = bytes_.size();
  for (int k = 0; k < 3; ++k) put_word(0);  // its end, its values, their bytes
  bytes_.push_back(static_cast<char>(name.size()));
  bytes_.append(name);
  record.values = bytes_.size();
  open_.push_back(record);
}

void FbxRecords::end_values(Open& record) {
  constexpr std::size_t word = sizeof(std::uint32_t);
  set_word(record.start + word, record.count);
  set_word(record.start + 2 * word, bytes_.size() - record.values);
}

void FbxRecords::end() {
  Open record = open_.back();
  open_.pop_back();
  if (!record.has_records) end_values(record);
  if (record.has_records || record.count == 0) bytes_.append(end_of_records);
  set_word(record.start, bytes_.size());
}

void FbxRecords::begin_value(char type) {
  ++open_.back().count;
  bytes_.push_back(type);
}

void FbxRecords::add(std::int32_t value) {
  begin_value('I');
  put_number(&value, sizeof value);
}

void FbxRecords::add(std::int64_t value) {
  begin_value('L');
  put_number(&value, sizeof value);
}

void FbxRecords::add(double value) {
  begin_value('D');
  put_number(&value, sizeof value);
}

void FbxRecords::add(std::string_view text) {
  begin_value('S');
  put_word(text.size());
  bytes_.append(text);
}

void FbxRecords::add_bytes(std::string_view bytes) {
  begin_value('R');
  put_word(bytes.size());
  bytes_.append(bytes);
}

void FbxRecords::add(const std::vector<double>& values) {
  put_array('d', values.data(), values.size(), sizeof(double));
}

void FbxRecords::add(const std::vector<float>& values) {
  put_array('f', values.data(), values.size(), sizeof(float));
}

void FbxRecords::add(const std::vector<std::int32_t>& values) {
  put_array('i', values.data(), values.size(), sizeof(std::int32_t));
}

void FbxRecords::add(const std::vector<std::int64_t>& values) {
  put_array('l', values.data(), values.size(), sizeof(std::int64_t));
}

void FbxRecords::put_array(char type, const void* values, std::size_t count, std::size_t size) {
  constexpr std::size_t worth_packing = 128;  // bytes
  begin_value(type);
  put_word(count);
  std::string packed;
  if (count * size > worth_packing) {
    uLongf length = compressBound(count * size);
    packed.resize(length);
    const auto* raw = static_cast<const Bytef*>(values);
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &length, raw, count * size,
                  Z_BEST_SPEED) != Z_OK) {
      throw Error(Fault::output, "FBX: an array could not be packed: out of memory");
    }
    packed.resize(length);
  }
  put_word(packed.empty() ? 0 : 1);
  put_word(packed.empty() ? count * size : packed.size());
  if (packed.empty()) {
    if (count > 0) put_number(values, count * size);
  } else {
    bytes_.append(packed);
  }
}

std::string FbxRecords::finish() && {
  bytes_.append(end_of_records);
  bytes_.append(first_mark);
  bytes_.append(4, '\0');
  bytes_.append(16 - bytes_.size() % 16, '\0');
  put_word(version);
  bytes_.append(120, '\0');
  bytes_.append(last_mark);
  if (bytes_.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(Fault::output,
                "FBX holds no more than 4 GB: write glb, and load its pictures from "
                "files of their own");
  }
  return std::move(bytes_);
}

}  // namespace curveskel
