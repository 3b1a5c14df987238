/* Times functions of C that CasADi generated, called from C.
 *
 *   bench_generated LIBRARY POINT REPEATS FUNCTION...
 *
 * POINT is text: for each argument its length, then its numbers. A function takes as many of the
 * arguments as it has inputs. Prints JSON: microseconds of each call, by function. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef long long (*count_function)(void);
typedef const long long* (*sparsity_function)(long long);
typedef int (*work_function)(long long*, long long*, long long*, long long*);
typedef int (*call_function)(const double**, double**, long long*, double*, int);

enum { kMaxArguments = 8 };

static void fail(const char* what, const char* which) {
  fprintf(stderr, "bench_generated: %s %s\n", what, which);
  exit(1);
}

static void* allocate(size_t count, size_t size) {
  void* memory = calloc(count > 0 ? count : 1, size);
  if (memory == NULL) fail("no memory for", "buffers");
  return memory;
}

static void* find(void* library, const char* function, const char* suffix) {
  char name[256];
  snprintf(name, sizeof name, "%s%s", function, suffix);
  void* symbol = dlsym(library, name);
  if (symbol == NULL) fail("the library lacks", name);
  return symbol;
}

static int read_point(const char* path, double* argument[kMaxArguments]) {
  FILE* file = fopen(path, "r");
  if (file == NULL) fail("cannot read", path);
  int count = 0;
  long length;
  while (count < kMaxArguments && fscanf(file, "%ld", &length) == 1) {
    argument[count] = allocate((size_t)length, sizeof(double));
    for (long i = 0; i < length; ++i)
      if (fscanf(file, "%lf", &argument[count][i]) != 1) fail("cut short:", path);
    ++count;
  }
  fclose(file);
  return count;
}

/* Entries of a sparsity in CasADi's compressed columns: rows, columns, offsets ... (or dense). */
static size_t entries(const long long* sparsity) {
  const long long columns = sparsity[1];
  if (sparsity[2] == 1) return (size_t)(sparsity[0] * columns);
  return (size_t)sparsity[2 + columns];
}

static double now_us(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static void time_function(void* library, const char* name, double* const* point, int given,
                          int repeats) {
  call_function call = (call_function)find(library, name, "");
  const long long inputs = ((count_function)find(library, name, "_n_in"))();
  const long long outputs = ((count_function)find(library, name, "_n_out"))();
  sparsity_function shape = (sparsity_function)find(library, name, "_sparsity_out");
  if (inputs > given) fail("too few arguments for", name);

  long long n_arg = inputs, n_res = outputs, n_iw = 0, n_w = 0;
  ((work_function)find(library, name, "_work"))(&n_arg, &n_res, &n_iw, &n_w);
  const double** arg = allocate((size_t)n_arg, sizeof *arg);
  double** res = allocate((size_t)n_res, sizeof *res);
  long long* iw = allocate((size_t)n_iw, sizeof *iw);
  double* w = allocate((size_t)n_w, sizeof *w);
  for (long long i = 0; i < inputs; ++i) arg[i] = point[i];
  for (long long i = 0; i < outputs; ++i) res[i] = allocate(entries(shape(i)), sizeof(double));

  printf("\"%s\": [", name);
  for (int i = 0; i < repeats; ++i) {
    const double began = now_us();
    if (call(arg, res, iw, w, 0) != 0) fail("an error from", name);
    printf("%s%.3f", i > 0 ? ", " : "", now_us() - began);
  }
  printf("]");
  for (long long i = 0; i < outputs; ++i) free(res[i]);
  free(arg);
  free(res);
  free(iw);
  free(w);
}

int main(int argc, char** argv) {
  if (argc < 5) fail("usage:", "bench_generated LIBRARY POINT REPEATS FUNCTION...");
  void* library = dlopen(argv[1], RTLD_NOW);
  if (library == NULL) fail("cannot load", dlerror());
  double* point[kMaxArguments];
  const int given = read_point(argv[2], point);
  const int repeats = atoi(argv[3]);
  printf("{");
  for (int i = 4; i < argc; ++i) {
    if (i > 4) printf(", ");
    time_function(library, argv[i], point, given, repeats);
  }
  printf("}\n");
  for (int i = 0; i < given; ++i) free(point[i]);
  return 0;
}
