/* The study's report: one HTML file that needs nothing else. Called by study.c. */
#ifndef DPL_STUDY_REPORT_HTML_H
#define DPL_STUDY_REPORT_HTML_H

#include "results.h"

#include "image/error.h"

/* Writes report.html; with `plots`, the SVGs that are in the folder are put into it. */
bool dpl_study_write_report(const dpl_study_results *results, bool plots, dpl_error *error);

#endif
