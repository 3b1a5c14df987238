/* What the back end of src/nlp/knitro.cpp calls of KNITRO's library, stated anew from its manual for
   the tests: KNITRO itself needs a licence. stub.cpp stands behind it. */
#pragma once

#define KN_INFINITY 1e20
#define KN_DENSE (-1)
#define KN_RC_EVALFC 1
#define KN_RC_EVALGA 2
#define KN_RC_EVALH 3
#define KN_RC_EVALH_NO_F 8
#define KN_RC_TIME_LIMIT_FEAS (-401)
#define KN_RC_TIME_LIMIT_INFEAS (-411)
#define KN_RC_EVAL_ERR (-502)
#define KN_RC_USER_TERMINATION (-504)

struct KN_context;
struct CB_context;

struct KN_eval_request {
  int type, threadID;
  const double *x, *lambda, *sigma, *vec;
};
struct KN_eval_result {
  double *obj, *c, *objGrad, *jac, *hess, *hessVec, *rsd, *rsdJac;
};

using KN_eval_callback = int(KN_context*, CB_context*, KN_eval_request*, KN_eval_result*, void*);
using KN_user_callback = int(KN_context*, const double* x, const double* lambda, void*);

extern "C" {
int KN_new(KN_context** kc);
int KN_free(KN_context** kc);
int KN_add_vars(KN_context* kc, int n, int* indices);
int KN_add_cons(KN_context* kc, int n, int* indices);
int KN_set_var_lobnds_all(KN_context* kc, const double* bounds);
int KN_set_var_upbnds_all(KN_context* kc, const double* bounds);
int KN_set_con_lobnds_all(KN_context* kc, const double* bounds);
int KN_set_con_upbnds_all(KN_context* kc, const double* bounds);
int KN_set_var_primal_init_values_all(KN_context* kc, const double* values);
int KN_set_var_dual_init_values_all(KN_context* kc, const double* values);
int KN_set_con_dual_init_values_all(KN_context* kc, const double* values);
int KN_add_eval_callback_all(KN_context* kc, KN_eval_callback* functions, CB_context** cb);
int KN_set_cb_grad(KN_context* kc, CB_context* cb, int variables, const int* gradient,
                   long long entries, const int* rows, const int* columns,
                   KN_eval_callback* derivatives);
int KN_set_cb_hess(KN_context* kc, CB_context* cb, long long entries, const int* first,
                   const int* second, KN_eval_callback* hessian);
int KN_set_cb_user_params(KN_context* kc, CB_context* cb, void* user);
int KN_set_newpt_callback(KN_context* kc, KN_user_callback* callback, void* user);
int KN_set_int_param_by_name(KN_context* kc, const char* name, int value);
int KN_set_double_param_by_name(KN_context* kc, const char* name, double value);
int KN_solve(KN_context* kc);
int KN_get_solution(KN_context* kc, int* status, double* objective, double* x, double* lambda);
int KN_get_number_iters(KN_context* kc, int* iterations);
}
