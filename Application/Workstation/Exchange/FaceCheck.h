#pragma once

#include <string>
#include <vector>

#include <QString>

#include "petrous/Scene/Case.h"

class QWidget;

namespace petrous::workstation
{

/// Whether a face can be recognised in the images of a case.
struct FaceCheck
{
  std::vector<std::string> images; ///< in which one can (presenters::facesToMask)
  bool isKnown = true;             ///< false: an image could not be read; there may be one

  bool mayHave() const { return !isKnown || !images.empty(); }
};

/// Looks for it in a separate thread, with a wait cursor, and a dialog if that takes long; returns
/// when it is known. The user can do nothing else meanwhile.
FaceCheck lookForFaces(const scene::Case& value, QWidget& parent);

/// What is to be asked about, a sentence; empty: nothing.
QString textOf(const FaceCheck& faces);

} // namespace petrous::workstation
