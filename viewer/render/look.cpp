#include "viewer/render/look.hpp"

namespace curveskel::viewer {

Palette palette_of(Theme theme) {
  if (theme == Theme::dark) {
    return {.upper = {0.13F, 0.15F, 0.18F},
            .lower = {0.08F, 0.09F, 0.11F},
            .surface = {0.66F, 0.73F, 0.80F},
            .inside = {0.85F, 0.62F, 0.50F},
            .body = {0.32F, 0.40F, 0.48F},
            .wire = {0.80F, 0.86F, 0.92F},
            .skeleton = {1.00F, 0.56F, 0.20F},
            .joint = {1.00F, 0.86F, 0.55F},
            .bone = {0.52F, 0.66F, 0.95F},
            .bone_joint = {0.84F, 0.91F, 1.00F},
            .casing = {0.05F, 0.06F, 0.08F},
            .contracted = {0.45F, 0.75F, 0.65F}};
  }
  return {.upper = {1.00F, 1.00F, 1.00F},
          .lower = {0.90F, 0.92F, 0.94F},
          .surface = {0.70F, 0.77F, 0.84F},
          .inside = {0.90F, 0.70F, 0.58F},
          .body = {0.50F, 0.60F, 0.70F},
          .wire = {0.15F, 0.20F, 0.26F},
          .skeleton = {0.80F, 0.20F, 0.09F},
          .joint = {0.35F, 0.06F, 0.04F},
          .bone = {0.27F, 0.36F, 0.66F},
          .bone_joint = {0.10F, 0.15F, 0.36F},
          .casing = {1.00F, 1.00F, 1.00F},
          .contracted = {0.36F, 0.66F, 0.56F}};
}

}  // namespace curveskel::viewer
