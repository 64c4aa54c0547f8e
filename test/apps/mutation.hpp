#pragma once

#include <random>
#include <string>
#include <vector>

namespace wingbeat {

// Damages texts and files in ways that repeat from a seed.
class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  // One of the texts with one to four faults: bytes, lines, values, keys and sections changed, lost, doubled
  // or taken from another text.
  std::string of_case(const std::vector<std::string>& texts);
  // Bytes with one to four faults: bits, runs of bytes and the end changed or lost. Half of them lie in the
  // first `head` bytes.
  std::string of_bytes(std::string bytes, std::size_t head);

  std::size_t below(std::size_t count);  // a number in [0, count)
  template <class List>
  const auto& one_of(const List& list) {
    return list[below(std::size(list))];
  }

 private:
  void damage_case(std::string& text, const std::vector<std::string>& texts);
  void damage_bytes(std::string& bytes, std::size_t head);
  std::string value();

  std::mt19937_64 random_;
};

}  // namespace wingbeat
