#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/Lazy.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Scene/Registration.h"
#include "petrous/Volume/ImageProvenance.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::scene
{

/// What the primary image was taken with. Cone beam and micro-CT are CTs whose values may be in
/// units of their own; an MR's always are.
enum class Modality
{
  Unknown, ///< neither the file nor the user said; treated as a CT
  Ct,
  Mr
};

/// Whose image it is, as SHA-256 of what identifies the patient: to compare, never to show. Each is
/// empty where the file does not state it.
struct PatientHash
{
  std::string id, issuer; ///< of the ID
  std::string name;
  std::string birthDate; ///< with the name: comparable only where the names are equal
  /// Of the words of the name and of their spellings without accents and joined, to find one in a
  /// text (ADR 0063). Images that an older version imported have those of the words alone, or none.
  std::vector<std::string> nameParts = {};

  bool empty() const { return id.empty() && name.empty() && birthDate.empty(); }
};

/// A CT or MR image of the case. Voxels are loaded on demand; the rest is available without them.
struct ImagePart
{
  std::string name;
  std::string object; ///< name in the object store; empty until saved
  core::GridGeometry geometry;
  volume::ValueRange range;
  std::vector<std::string> notes;        ///< what was accepted on reading the image, for the user
  volume::ImageProvenance provenance;    ///< what of it counts wherever the image goes
  Modality modality = Modality::Unknown; ///< of the primary image (Case::ct); others: Unknown
  core::Lazy<volume::IntensityVolume> volume;
  /// X_MC: CT patient points to this image's patient points, LPS mm; identity until registered.
  core::RigidTransform mrFromCt;
  bool registered = false;
  /// Set by applyRegistration (ApplyRegistration.h). nullopt until registered.
  std::optional<Registration> registration;
  /// SHA-256 of the file's frame of reference UID (DICOM C.7.4.1): images with the same value were
  /// acquired in one position of the patient, according to the scanner. Empty: unknown.
  std::string frameOfReference;
  PatientHash patient; ///< empty: unknown
  /// Whether both were hashed again with the library's secret salt, as Library::save does;
  /// comparable with another image's only if its are or neither's.
  bool isFrameSalted = false;
  std::string saltId; ///< IdentitySalt::id of that salt
};

/// A library's secret salt, as the function that hashes with it.
class IdentitySalt
{
public:
  using Hash = std::function<std::string(const std::string&)>;

  IdentitySalt() = default;
  template <class Function>
  IdentitySalt(Function hash, std::function<std::string()> id = {})
    : m_hash(std::move(hash))
    , m_id(std::move(id))
  {
  }

  explicit operator bool() const { return static_cast<bool>(m_hash); }
  std::string operator()(const std::string& hash) const { return m_hash(hash); }
  /// Tells salts apart without telling anything of them. Empty: a salt of the program's versions
  /// that did not write which one it was, and that had one form; those since have another.
  std::string id() const { return m_id ? m_id() : std::string(); }

private:
  Hash m_hash;
  std::function<std::string()> m_id;
};

/// Hashes frame of reference and patient again by `salt`, unless they are already.
void saltIdentity(ImagePart& image, const IdentitySalt& salt);

/// Whether hashes with `salt`, or plain ones, can be compared with those of the image. Those of a
/// salt that was lost say nothing any more.
bool isComparable(const ImagePart& image, const IdentitySalt& salt);

/// Whether the image has hashes that were salted.
bool hasSaltedIdentity(const ImagePart& image);

/// Forgets frame of reference and patient, which another library salted.
void forgetIdentity(ImagePart& image);

} // namespace petrous::scene
