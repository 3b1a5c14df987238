#include "kept_functions.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "../base/same_bits.hpp"

namespace slalom::expr {
namespace {

bool same_steps(const std::shared_ptr<const Steps>& a, const std::shared_ptr<const Steps>& b) {
  return a == b || (same_bits(a->begins, b->begins) && same_bits(a->values, b->values));
}

bool same_vertex(const Dag::Vertex& a, const Dag::Vertex& b) {
  return a.op == b.op && a.arg == b.arg && same_bits(a.value, b.value);
}

void mix(std::uint64_t part, std::uint64_t& hash) {
  hash = (hash ^ part) * 0x9E3779B97F4A7C15ull;
  hash ^= hash >> 29;
}

}  // namespace

Function::Impl::Kept::Key::Key(const Impl& function)
    : variables(function.variables),
      data(function.data),
      outputs(function.outputs),
      vertices(function.dag.vertices()),
      steps(function.dag.all_steps()) {
  for (const std::size_t number : {variables, data, outputs.size(), steps.size()})
    mix(number, hash);
  size += outputs.size() + vertices.size();
  for (const auto& each : steps) size += each->values.size();
  for (const Dag::Id id : outputs) mix(id, hash);
  for (const auto& v : vertices) {
    mix(static_cast<std::uint64_t>(v.op) << 32 | v.arg[0], hash);
    mix(std::uint64_t{v.arg[1]} << 32 | v.arg[2], hash);
    mix(std::bit_cast<std::uint64_t>(v.value), hash);
  }
}

bool Function::Impl::Kept::Key::operator==(const Key& other) const {
  return hash == other.hash && variables == other.variables && data == other.data &&
         outputs == other.outputs &&
         std::equal(vertices.begin(), vertices.end(), other.vertices.begin(), other.vertices.end(),
                    same_vertex) &&
         std::equal(steps.begin(), steps.end(), other.steps.begin(), other.steps.end(), same_steps);
}

Function::Impl::Kept& Function::Impl::Kept::instance() {
  static Kept kept;
  return kept;
}

Function::Impl::Kept::Shared Function::Impl::Kept::instead_of(Shared made) {
  if (made->dag.size() > kLargest) return made;
  Key key(*made);
  if (key.size > kLargest) return made;
  std::vector<Entry> dropped;  // destroyed once the lock is released
  const std::lock_guard lock(mutex_);
  const auto same = std::find_if(entries_.begin(), entries_.end(),
                                 [&](const Entry& entry) { return entry.key == key; });
  if (same != entries_.end()) {
    std::rotate(same, same + 1, entries_.end());
    return entries_.back().function;
  }
  make_room(key.size, dropped);
  size_ += key.size;
  entries_.push_back({std::move(key), made});
  return made;
}

void Function::Impl::Kept::make_room(std::size_t wanted, std::vector<Entry>& dropped) {
  auto first = entries_.begin();
  for (; first != entries_.end() && size_ + wanted > kRoom; ++first) {
    size_ -= first->key.size;
    dropped.push_back(std::move(*first));
  }
  entries_.erase(entries_.begin(), first);
}

}  // namespace slalom::expr
