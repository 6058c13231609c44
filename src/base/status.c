/* Texts of statuses and the version. Public, called by anyone. */
#include <dapple/status.h>
#include <dapple/version.h>

const char *dpl_status_text(dpl_status status) {
    static const char *const texts[] = {
#define DPL_STATUS_TEXT(name, text) text,
        DPL_STATUS_LIST(DPL_STATUS_TEXT)
#undef DPL_STATUS_TEXT
    };
    const int count = (int)(sizeof texts / sizeof texts[0]);
    return (int)status >= 0 && (int)status < count ? texts[status] : "unknown status";
}

#define DPL_STRING(x) #x
#define DPL_VERSION_STRING(major, minor, patch) DPL_STRING(major) "." DPL_STRING(minor) "." DPL_STRING(patch)

const char *dpl_version(void) {
    return DPL_VERSION_STRING(DPL_VERSION_MAJOR, DPL_VERSION_MINOR, DPL_VERSION_PATCH);
}
