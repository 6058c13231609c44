/* The study's tables: results.csv, signals.csv, summary.csv, correlations.csv, headlines.csv and
 * below-50-db.csv. Called by study.c.
 *
 * An empty cell: there is no such number (off vs off; dead rays where there are none). "inf": no error.
 * Means, smallest and largest leave infinite values out, and a column beside them says how many there were.
 */
#ifndef DPL_STUDY_CSV_H
#define DPL_STUDY_CSV_H

#include "results.h"

#include "image/error.h"

bool dpl_study_write_tables(const dpl_study_results *results, dpl_error *error);

#endif
