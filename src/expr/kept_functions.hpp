#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "dag.hpp"
#include "function_impl.hpp"

namespace slalom::expr {

/// The last functions made, whoever made them: one of the same graph as one of these is the same
/// object, whose derivatives and code are there already. A sweep's second trial, threads that plan
/// side by side and problems stated again need not derive what was derived before. Thread-safe.
///
/// A function that nobody else holds is kept as long as there is room, the last used ones first.
class Function::Impl::Kept {
 public:
  using Shared = std::shared_ptr<const Impl>;

  /// The process's own.
  static Kept& instance();

  /// The kept function that `made` equals; else `made`, kept from now on if it is not too large.
  Shared instead_of(Shared made);

  /// What is kept may be so large, in vertices before differentiation, all together and each.
  static constexpr std::size_t kRoom = 20000, kLargest = 2000;

 private:
  /// What determines everything that is made of a function; copied, for graphs grow.
  struct Key {
    explicit Key(const Impl& function);
    bool operator==(const Key& other) const;

    std::size_t variables, data, size = 1;
    std::vector<Dag::Id> outputs;
    std::vector<Dag::Vertex> vertices;
    std::vector<std::shared_ptr<const Steps>> steps;
    std::uint64_t hash = 0;
  };
  struct Entry {
    Key key;
    Shared function;
  };

  void make_room(std::size_t wanted, std::vector<Entry>& dropped);

  std::mutex mutex_;
  std::vector<Entry> entries_;  ///< the last used one at the end
  std::size_t size_ = 0;        ///< vertices of all keys
};

}  // namespace slalom::expr
