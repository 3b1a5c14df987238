#include "binding.hpp"

#include <algorithm>
#include <memory>

#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"

namespace slalom::python {
namespace {

/// Seconds between two questions for an interrupt.
constexpr double kPatience = 0.05;

double now() {
  static const Timer timer;
  return timer.wall();
}

}  // namespace

Vector to_numpy(const std::vector<double>& numbers) {
  auto copy = std::make_unique<std::vector<double>>(numbers);
  auto* data = copy->data();
  const std::size_t size = copy->size();
  nb::capsule owner(copy.release(),
                    [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
  return Vector(data, {size}, owner);
}

Matrix to_numpy(const std::vector<std::vector<double>>& rows, std::size_t columns) {
  auto flat = std::make_unique<std::vector<double>>();
  flat->reserve(rows.size() * columns);
  for (const auto& row : rows) {
    if (row.size() != columns) throw Error("rows of unequal length");
    flat->insert(flat->end(), row.begin(), row.end());
  }
  auto* data = flat->data();
  nb::capsule owner(flat.release(),
                    [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
  return Matrix(data, {rows.size(), columns}, owner);
}

void warn(const std::string& message) {
  if (PyErr_WarnEx(PyExc_UserWarning, message.c_str(), 1) != 0) throw nb::python_error();
}

Released::Released() : asked_(now()) {}

bool Released::interrupted() {
  if (interrupted_ || now() - asked_ < kPatience) return interrupted_;
  const nb::gil_scoped_acquire lock;
  interrupted_ = PyErr_CheckSignals() != 0;
  asked_ = now();
  return interrupted_;
}

void Released::raise_if_interrupted() const {
  if (interrupted_) throw nb::python_error();
}

}  // namespace slalom::python
