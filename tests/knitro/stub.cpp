// A stub of KNITRO's library: KN_solve takes Newton's steps on the equations of a problem without
// active inequalities, from what the callbacks give, which tells whether structure and signs are
// right.

#include "stub.hpp"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "knitro.h"

KnitroStub& KnitroStub::get() {
  static KnitroStub stub;
  return stub;
}

struct CB_context {};

struct KN_context {
  CB_context callback;
  std::size_t n = 0, m = 0;
  std::vector<double> x, lambda;
  std::vector<int> rows, columns, first, second;
  KN_eval_callback *functions = nullptr, *derivatives = nullptr, *hessian = nullptr;
  KN_user_callback* each = nullptr;
  void *user = nullptr, *each_user = nullptr;
  double objective = 0;
  int status = 0, iterations = 0;
};

namespace {

KnitroStub& stub() {
  return KnitroStub::get();
}

/// Gaussian elimination with pivoting, in place: a becomes garbage, b the solution.
void eliminate(std::vector<std::vector<double>>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
}

/// One step; the largest change, or a negative code.
double newton(KN_context& kc) {
  std::vector<double> c(kc.m), gradient(kc.n), jacobian(kc.rows.size()), hessian(kc.first.size());
  const double sigma = 1;
  KN_eval_request request{KN_RC_EVALFC, 0, kc.x.data(), kc.lambda.data(), &sigma, nullptr};
  KN_eval_result result{&kc.objective,  c.data(), gradient.data(), jacobian.data(),
                        hessian.data(), nullptr,  nullptr,         nullptr};
  if (kc.functions(&kc, &kc.callback, &request, &result, kc.user) != 0) return KN_RC_EVAL_ERR;
  request.type = KN_RC_EVALGA;
  if (kc.derivatives(&kc, &kc.callback, &request, &result, kc.user) != 0) return KN_RC_EVAL_ERR;
  request.type = KN_RC_EVALH;
  if (kc.hessian(&kc, &kc.callback, &request, &result, kc.user) != 0) return KN_RC_EVAL_ERR;
  std::vector<std::vector<double>> system(kc.n + kc.m, std::vector<double>(kc.n + kc.m));
  std::vector<double> step(kc.n + kc.m);
  for (std::size_t e = 0; e < hessian.size(); ++e) {
    if (kc.first[e] > kc.second[e]) std::abort();  // not the upper triangle
    system[kc.first[e]][kc.second[e]] += hessian[e];
    if (kc.first[e] != kc.second[e]) system[kc.second[e]][kc.first[e]] += hessian[e];
  }
  for (std::size_t i = 0; i < kc.n; ++i) step[i] = -gradient[i];
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    const std::size_t row = kc.n + kc.rows[e], col = kc.columns[e];
    system[row][col] += jacobian[e];
    system[col][row] += jacobian[e];
    step[col] -= kc.lambda[kc.rows[e]] * jacobian[e];
  }
  for (std::size_t r = 0; r < kc.m; ++r) step[kc.n + r] = stub().gl[r] - c[r];
  eliminate(system, step);
  double most = 0;
  for (std::size_t i = 0; i < kc.n; ++i) kc.x[i] += step[i];
  for (std::size_t r = 0; r < kc.m; ++r) kc.lambda[r] += step[kc.n + r];
  for (const double change : step) most = std::max(most, std::fabs(change));
  return most;
}

}  // namespace

extern "C" {

int KN_new(KN_context** kc) {
  if (!stub().licence) return -520;
  *kc = new KN_context;
  ++stub().contexts;
  return 0;
}
int KN_free(KN_context** kc) {
  delete *kc;
  *kc = nullptr;
  --stub().contexts;
  return 0;
}
int KN_add_vars(KN_context* kc, int n, int*) {
  kc->n = n;
  kc->x.assign(n, 0);
  kc->lambda.assign(n, 0);
  return 0;
}
int KN_add_cons(KN_context* kc, int n, int*) {
  kc->m = n;
  kc->lambda.assign(kc->n + kc->m, 0);
  return 0;
}
int KN_set_var_lobnds_all(KN_context* kc, const double* b) {
  stub().xl.assign(b, b + kc->n);
  return 0;
}
int KN_set_var_upbnds_all(KN_context* kc, const double* b) {
  stub().xu.assign(b, b + kc->n);
  return 0;
}
int KN_set_con_lobnds_all(KN_context* kc, const double* b) {
  stub().gl.assign(b, b + kc->m);
  return 0;
}
int KN_set_con_upbnds_all(KN_context* kc, const double* b) {
  stub().gu.assign(b, b + kc->m);
  return 0;
}
int KN_set_var_primal_init_values_all(KN_context* kc, const double* v) {
  kc->x.assign(v, v + kc->n);
  stub().x = kc->x;
  return 0;
}
int KN_set_var_dual_init_values_all(KN_context* kc, const double* v) {
  stub().z.assign(v, v + kc->n);
  for (std::size_t i = 0; i < kc->n; ++i) kc->lambda[kc->m + i] = v[i];
  return 0;
}
int KN_set_con_dual_init_values_all(KN_context* kc, const double* v) {
  stub().y.assign(v, v + kc->m);
  for (std::size_t r = 0; r < kc->m; ++r) kc->lambda[r] = v[r];
  return 0;
}
int KN_add_eval_callback_all(KN_context* kc, KN_eval_callback* functions, CB_context** cb) {
  kc->functions = functions;
  *cb = &kc->callback;
  return 0;
}
int KN_set_cb_grad(KN_context* kc, CB_context*, int variables, const int*, long long entries,
                   const int* rows, const int* columns, KN_eval_callback* derivatives) {
  if (variables != KN_DENSE) return -1;
  kc->rows.assign(rows, rows + entries);
  kc->columns.assign(columns, columns + entries);
  kc->derivatives = derivatives;
  return 0;
}
int KN_set_cb_hess(KN_context* kc, CB_context*, long long entries, const int* first,
                   const int* second, KN_eval_callback* hessian) {
  kc->first.assign(first, first + entries);
  kc->second.assign(second, second + entries);
  kc->hessian = hessian;
  return 0;
}
int KN_set_cb_user_params(KN_context* kc, CB_context*, void* user) {
  kc->user = user;
  return 0;
}
int KN_set_newpt_callback(KN_context* kc, KN_user_callback* callback, void* user) {
  kc->each = callback;
  kc->each_user = user;
  return 0;
}
int KN_set_int_param_by_name(KN_context*, const char* name, int value) {
  stub().parameters[name] = value;
  return 0;
}
int KN_set_double_param_by_name(KN_context*, const char* name, double value) {
  stub().parameters[name] = value;
  return 0;
}
int KN_solve(KN_context* kc) {
  for (;;) {
    if (kc->iterations >= stub().parameters["maxit"]) return kc->status = -400;
    const double change = newton(*kc);
    if (change < 0) return kc->status = static_cast<int>(change);
    ++kc->iterations;
    if (const int code = kc->each(kc, kc->x.data(), kc->lambda.data(), kc->each_user); code != 0)
      return kc->status = code;
    if (change < 1e-12) return kc->status = stub().result;
  }
}
int KN_get_solution(KN_context* kc, int* status, double* objective, double* x, double* lambda) {
  *status = kc->status;
  *objective = kc->objective;
  std::copy(kc->x.begin(), kc->x.end(), x);
  std::copy(kc->lambda.begin(), kc->lambda.end(), lambda);
  return 0;
}
int KN_get_number_iters(KN_context* kc, int* iterations) {
  *iterations = kc->iterations;
  return 0;
}
}
