// Reads the keys of one section of a device file into SI.
#pragma once

#include <dashpot/command.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "network/dimension.hpp"
#include "source/diagnostic.hpp"
#include "syntax/device_decl.hpp"

namespace dashpot::compiler {

enum class Bound { any, zero_or_more, above_zero };

// A key that people write where another is meant, and the function that notes the remedy.
struct KeyRemedy {
  std::string_view key;
  std::function<void(const EntryDecl&)> note;
};

// In SI, where it is one quantity of this dimension; reports nothing.
std::optional<double> stated_in(const EntryDecl& entry, const Dimension& dimension);

// Every read leaves its target unchanged if the key is absent, or if its value is not what is due, which is reported.
class SectionReader {
 public:
  SectionReader(const DeviceDecl& decl, std::string name, motion joint_motion, Diagnostics& diagnostics);

  bool is_present() const { return section_ != nullptr; }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  bool is_list(std::string_view key) const { return has(key) && find(key)->is_list; }
  void require(std::string_view key) const;  // reports where the section, if present, lacks it and did not misspell it
  void refuse_other_keys(const std::vector<std::string>& keys, const std::vector<KeyRemedy>& remedies = {});

  // Whether it gave its value.
  bool read(std::string_view key, const Dimension& due, Bound bound, double& target) const;
  // `may_be_one`: whether both may be the same.
  void read_pair(std::string_view key, const Dimension& due, Bound bound, double& low, double& high,
                 bool may_be_one = false) const;
  // False, with a diagnostic, for a value that was read and is not from `low` to `high`.
  bool is_within(std::string_view key, double value, double low, double high, std::string_view unit) const;
  // A value that is to be from `low` to `high`; whether it is. Of one that is refused already nothing more is reported.
  bool read_within(std::string_view key, const Dimension& due, Bound bound, double low, double high,
                   std::string_view unit, double& target) const;
  void read_count(std::string_view key, unsigned least, unsigned& target) const;

  // The index of the word among `words`.
  std::optional<std::size_t> read_word(std::string_view key, const std::vector<std::string>& words) const;

  // Of the key's value; of the section where there is none.
  Span place_of(std::string_view key) const;

  // In SI, where the key has one quantity of this dimension; reports nothing.
  std::optional<double> stated(std::string_view key, const Dimension& dimension) const;

  // As the author wrote it.
  std::string text_of(std::string_view key) const;

 private:
  const EntryDecl* find(std::string_view key) const;
  const ValueDecl* find_single(std::string_view key) const;
  std::optional<double> value_of(const ValueDecl& decl, std::string_view key, const Dimension& due, Bound bound) const;
  std::string dotted(std::string_view key) const;

  const SectionDecl* section_ = nullptr;
  std::string name_;
  motion motion_;
  Diagnostics& diagnostics_;
  std::vector<std::string> misspelt_;
};

}  // namespace dashpot::compiler
