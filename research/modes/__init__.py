"""Why a gait forms: modes of compliant legs under a rigid trunk, and the feedback on them."""
