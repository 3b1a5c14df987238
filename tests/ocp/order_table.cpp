// Prints docs/convergence.md: the orders of convergence measured on problems solved on paper.

#include <cstdio>

#include "ocp/orders.hpp"

int main() {
  using namespace slalom::ocp;
  std::fputs(order_page(measure_orders()).c_str(), stdout);
}
