/* The picture of the job: views of the part in the colours of its deviation, notes, colour bar. */
#ifndef PROPELLER_PICTURE_H
#define PROPELLER_PICTURE_H

#include "measure.h"
#include "report.h"
#include "scan.h"



/* Writes the PNG. Returns FPT_OK; FPT_OUT_OF_MEMORY also when the file could not be written. */
fpt_status picture_write(const part *p, const scan *s, const measurement *m, const report *r, const char *path);

#endif
