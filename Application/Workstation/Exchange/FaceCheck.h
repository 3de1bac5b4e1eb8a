#pragma once

#include <memory>
#include <vector>

#include <QString>
#include <QStringList>

#include "petrous/Scene/ImageMask.h"

class QWidget;

namespace petrous::workstation
{

/// Whether a face can be recognised in the images of a case.
struct FaceCheck
{
  std::vector<scene::ImageWithFace> images; ///< in which one can (presenters::facesToMask)
  bool isKnown = true;                      ///< false: an image could not be read; there may be one
  bool isCancelled = false; ///< by the user, who wants nothing of what it is for, or at the end of
                            ///< the program
  std::shared_ptr<const scene::FaceFindings> found; ///< for scene::ImageMask; nullptr: nothing

  bool mayHave() const { return !isKnown || !images.empty(); }
};

/// Looks for it in a separate thread, with a wait cursor, and a dialog if that takes long; returns
/// when it is known, or the user cancels it, who can do nothing else meanwhile.
FaceCheck lookForFaces(const scene::Case& value, QWidget& parent);

/// What is to be asked about, a sentence; empty: nothing.
QString textOf(const FaceCheck& faces);
/// That the face was left in these images, and what to do about it: a sentence each.
QStringList warningsOf(const std::vector<scene::ImageWithFace>& left);
/// "the CT", "MR “T2”".
QString textOf(const scene::ImageWithFace& image);

} // namespace petrous::workstation
