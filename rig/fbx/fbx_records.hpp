// FBX's binary form, record by record. Internal to rig/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace curveskel {

/// A file of version 7.4 as it grows: begin, values, records within, end.
class FbxRecords {
 public:
  FbxRecords();

  void begin(std::string_view name);
  /// Precondition: every begin within has its end.
  void end();

  /// Values of the record that was begun last. Precondition: none has been begun within it.
  void add(std::int32_t value);
  void add(std::int64_t value);
  void add(double value);
  void add(std::string_view text);
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(const char* text) { add(std::string_view(text)); }
  void add(const std::vector<double>& values);
  void add(const std::vector<float>& values);
  void add(const std::vector<std::int32_t>& values);
  void add(const std::vector<std::int64_t>& values);
  void add_bytes(std::string_view bytes);

  template <typename... Values>
  void record(std::string_view name, const Values&... values) {
    begin(name);
    (add(values), ...);
    end();
  }
  /// A line of "Properties70".
  template <typename... Values>
  void property(std::string_view name, std::string_view type, std::string_view label,
                std::string_view flags, const Values&... values) {
    record("P", name, type, label, flags, values...);
  }

  /// The whole file. Throws Error(Fault::output) beyond 4 GB. Precondition: all records are ended.
  [[nodiscard]] std::string finish() &&;

 private:
  struct Open {
    std::size_t start = 0;
    std::size_t values = 0;  // where they begin
    std::uint32_t count = 0;
    bool has_records = false;
  };

  void begin_value(char type);
  void end_values(Open& record);
  void put_number(const void* number, std::size_t size);
  void put_word(std::size_t number);
  void set_word(std::size_t at, std::size_t number);
  void put_array(char type, const void* values, std::size_t count, std::size_t size);

  std::string bytes_;
  std::vector<Open> open_;
};

}  // namespace curveskel
