/* Asks the system what it is. Called by both benchmarks. */
#define _DEFAULT_SOURCE
#include "machine.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static void read_cpu(char *cpu, size_t size) {
    char line[512];
    snprintf(cpu, size, "unknown processor");
    FILE *file = fopen("/proc/cpuinfo", "r");
    if (!file)
        return;
    while (fgets(line, sizeof line, file)) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon)
            continue;
        line[strcspn(line, "\n")] = 0;
        snprintf(cpu, size, "%.*s", (int)size - 1, colon + 1 + strspn(colon + 1, " \t"));
        break;
    }
    fclose(file);
}

/* Trade marks and the clock rate say nothing in a folder's name. */
static void make_slug(const char *cpu, char *slug, size_t size) {
    size_t used = 0;
    for (const char *c = cpu; *c && *c != '@' && used + 2 < size; c++) {
        if (*c == '(') {
            c += strcspn(c, ")");
            if (!*c)
                break;
        } else if (isalnum((unsigned char)*c)) {
            slug[used++] = (char)tolower((unsigned char)*c);
        } else if (used > 0 && slug[used - 1] != '-') {
            slug[used++] = '-';
        }
    }
    while (used > 0 && slug[used - 1] == '-')
        used--;
    slug[used] = 0;
}

static void read_compiler(char *text, size_t size) {
#if defined(__clang__)
    snprintf(text, size, "clang %d.%d.%d", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    snprintf(text, size, "gcc %d.%d.%d", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    snprintf(text, size, "unknown compiler");
#endif
}

dpl_bench_machine dpl_bench_machine_read(void) {
    dpl_bench_machine machine;
    memset(&machine, 0, sizeof machine);
    read_cpu(machine.cpu, sizeof machine.cpu);
    make_slug(machine.cpu, machine.slug, sizeof machine.slug);
    read_compiler(machine.compiler, sizeof machine.compiler);
    snprintf(machine.build, sizeof machine.build, "%s%s%s", DPL_BUILD_TYPE,
             DPL_BUILD_SANITIZE[0] ? " with sanitizer " : "", DPL_BUILD_SANITIZE);
    machine.processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    time_t now = time(NULL);
    struct tm parts;
    if (gmtime_r(&now, &parts))
        strftime(machine.date, sizeof machine.date, "%Y-%m-%d %H:%M UTC", &parts);
    if (getloadavg(&machine.load, 1) != 1)
        machine.load = -1;
    return machine;
}

void dpl_bench_machine_write(const dpl_bench_machine *machine, const dpl_context *context, FILE *stream) {
    fprintf(stream, "- machine: %s, %d processors, load %.2f when it began (own work not yet in it); %s\n",
            machine->cpu, machine->processors, machine->load, machine->date);
    fprintf(stream, "- build: %s, %s, kernels %s, commit %s\n", machine->compiler, machine->build,
            dpl_isa_name(dpl_context_isa(context)), dpl_bench_commit());
}
