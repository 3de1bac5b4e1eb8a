#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "petrous/Library/Deidentification.h"

namespace petrous::library
{

/// Action codes of PS3.15 Table E.1-1a.
enum class DeidAction
{
  Remove,  ///< X
  Empty,   ///< Z
  Dummy,   ///< D
  NewUid,  ///< U
  Keep,    ///< K
  Clean,   ///< C: reduced to the vocabulary
  Shift,   ///< C of dates
  Unlisted ///< not in the table
};

/// Types of attributes in the IODs that Petrous reads. Others: what keeps any IOD valid.
enum class IodKind
{
  Plain, ///< CT, MR and other images of one frame
  Enhanced,
  Pet,
  StructureSet,
  Other
};

IodKind iodKindOf(const std::string& sopClass);

/// PS3.15 Table E.1-1 and E.3.10-1, from Resources.
class ConfidentialityProfile
{
public:
  ConfidentialityProfile();

  const std::string& edition() const noexcept { return m_edition; }

  /// `tag` is group << 16 | element.
  ///
  /// Combined actions (X/Z, X/D, Z/D, X/Z/D, X/Z/U) at the top level of a known IOD: the first,
  /// which removes most, unless the attribute's type in that IOD requires more (type 2: Z, type 1:
  /// D). Elsewhere, within sequences too, the last one, which is valid whatever the type.
  /// References to images (X/Z/U*) are kept with new UIDs; Patient ID (Z/D) is a pseudonym.
  DeidAction action(std::uint32_t tag, IodKind iod, bool nested,
                    const DeidentificationOptions& options) const;

  /// The VR of a safe private attribute; empty: it is none. element: 0 to 0xff, within the block of
  /// `creator`.
  std::string safePrivateVr(const std::string& creator, std::uint16_t group,
                            std::uint16_t element) const;

  /// One value of VR CS: PS3.3 defines or enumerates it for this attribute, or it is a term that
  /// Resources/added-terms.tsv adds.
  bool isDefinedTerm(std::uint32_t tag, const std::string& value) const;

private:
  struct Row
  {
    std::string basic; ///< e.g. "XZD"
    char dates = 0, shifted = 0, device = 0, patient = 0, descriptors = 0;
  };

  std::string m_edition;
  std::unordered_map<std::uint32_t, Row> m_rows;
  std::unordered_map<std::uint32_t, std::unordered_set<std::string>> m_terms; ///< 0: of any
  /// VR by creator, and by group << 16 | element.
  std::unordered_map<std::string, std::unordered_map<std::uint32_t, std::string>> m_safe;
};

} // namespace petrous::library
