/* The picture of the job: views of the part in the colours of its deviation, notes, colour bar. */
#ifndef PROPELLER_PICTURE_H
#define PROPELLER_PICTURE_H

#include "image.h"
#include "measure.h"
#include "report.h"
#include "scan.h"

/* Paints a new picture, for image_write_png() and image_free(). On failure there is nothing to free. */
fpt_status picture_new(const part *p, const scan *s, const measurement *m, const report *r, image *out);

#endif
