#include "MaskOptions.h"

#include "Numbers.h"

namespace petrous::cli
{

scene::ImageMask MaskOptions::mask() const
{
  scene::ImageMask mask;
  mask.face = face || ears;
  mask.ears = ears;
  if (!roi.empty())
    mask.region = parseBox(roi, "--roi");
  return mask;
}

void addMaskOptions(CLI::App& command, MaskOptions& options)
{
  command.add_flag("--mask-face", options.face,
                   "Put air in place of the face, in front of a plane about 50 mm behind the tip "
                   "of the nose; structures, drilled bone and temporal bones stay");
  command.add_flag("--mask-ears", options.ears, "The face and the auricles");
  command
      .add_option("--roi", options.roi,
                  "Put air in place of all outside of this box, patient LPS mm; the grid stays")
      ->type_name("x0,x1,y0,y1,z0,z1");
}

} // namespace petrous::cli
