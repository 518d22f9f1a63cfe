// Indices into the tables of an update law. Every table has an id type of its own, so that the id of a constant cannot
// be taken for that of a variable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace dashpot::compiler {

// An id that refers to no entry.
struct Nothing {};
inline constexpr Nothing nothing{};

template <class Entry>
class Id {
 public:
  constexpr Id() = default;
  constexpr Id(Nothing) {}
  explicit constexpr Id(std::size_t place) : place_(static_cast<std::uint32_t>(place)) {}

  constexpr std::size_t place() const { return place_; }
  constexpr bool is_nothing() const { return place_ == of_nothing; }

  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  static constexpr std::uint32_t of_nothing = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t place_ = of_nothing;
};

// A vector that is indexed by its own ids only.
template <class Entry>
class Table : private std::vector<Entry> {
  using Entries = std::vector<Entry>;

 public:
  using Entries::begin, Entries::end, Entries::size, Entries::empty;

  Entry& operator[](Id<Entry> id) { return Entries::operator[](id.place()); }
  const Entry& operator[](Id<Entry> id) const { return Entries::operator[](id.place()); }

  Id<Entry> add(Entry entry) {
    Entries::push_back(std::move(entry));
    return Id<Entry>(Entries::size() - 1);
  }

  // The id of an entry of this table.
  Id<Entry> id_of(const Entry& entry) const { return Id<Entry>(static_cast<std::size_t>(&entry - Entries::data())); }

  bool has(Id<Entry> id) const { return id.place() < Entries::size(); }

  bool operator==(const Table&) const = default;
};

}  // namespace dashpot::compiler
